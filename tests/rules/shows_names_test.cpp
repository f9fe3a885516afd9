// SPDX-License-Identifier: Apache-2.0
// Names that engines bind by.
#include "rules/shows_assets.hpp"

namespace gltfx::test {
namespace {

void morphs(Drawn& d, std::size_t targets, const std::vector<std::string>& names) {
  const Shape shape = d.shape(1);
  Json primitive = d.primitive(shape);
  for (std::size_t i = 0; i < targets; ++i) {
    std::vector<Point> moves(shape.points.size(), Point{});
    moves[i % moves.size()] = d.point(0.2);
    primitive["targets"].push_back({{"POSITION", d.positions(moves)}});
  }
  Json more{{"extras", {{"targetNames", names}}}};
  if (targets > 0) more["weights"] = std::vector<int>(targets, 0);
  d.root({{"mesh", d.mesh(std::move(primitive), more)}});
}

std::vector<std::string> names(std::size_t count) {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < count; ++i) names.push_back(fmt::format("face {}", i));
  return names;
}

std::size_t some(Drawn& d, int least) { return static_cast<std::size_t>(d.pick(least, 9)); }

TEST(MorphTargetNames, AreOneForEachTarget) {
  expect_found("MORPH_TARGET_NAMES_COUNT", "/meshes/0/extras/targetNames",
               {
                   [](Drawn& d) {
                     const std::size_t count = some(d, 2);
                     morphs(d, count, names(count - 1));
                   },
                   [](Drawn& d) {
                     const std::size_t count = some(d, 1);
                     morphs(d, count, names(count + some(d, 1)));
                   },
                   [](Drawn& d) { morphs(d, some(d, 1), {}); },
               });
  expect_silent({
      [](Drawn& d) {
        const std::size_t count = some(d, 1);
        morphs(d, count, names(count));
      },
      [](Drawn& d) { morphs(d, 1, {"only"}); },
      [](Drawn& d) {
        std::vector<std::string> all = names(3);
        all[static_cast<std::size_t>(d.pick(0, 2))] = "FACE 0";
        morphs(d, 3, all);
      },
  });
}

TEST(MorphTargetNames, AreDifferent) {
  const auto doubled = [](Drawn& d, std::size_t count, const std::string& name) {
    std::vector<std::string> all = names(count);
    const auto first = static_cast<std::size_t>(d.pick(0, static_cast<int>(count) - 2));
    all[first] = name;
    all[static_cast<std::size_t>(
        d.pick(static_cast<int>(first) + 1, static_cast<int>(count) - 1))] = name;
    morphs(d, count, all);
  };
  expect_found("MORPH_TARGET_NAME_REPEATED", "/meshes/0/extras/targetNames/",
               {
                   [&](Drawn& d) { doubled(d, some(d, 2), "smile"); },
                   [&](Drawn& d) { doubled(d, some(d, 2), "l\u00e4cheln"); },
                   [&](Drawn& d) {
                     const std::size_t count = some(d, 2);
                     morphs(d, count, std::vector<std::string>(count, "Key"));
                   },
               });
}

TEST(MorphTargetNames, AreCompletedByAnUnsafeFix) {
  Drawn drawn(3);
  morphs(drawn, 3, {"smile", "target_1"});
  FixOptions options;
  options.only = {"MORPH_TARGET_NAMES_COUNT"};
  options.unsafe = true;
  MemoryAsset asset{drawn.text(), {}};
  asset.name = "face.gltf";
  const auto fixed = fix_bytes(asset, options);
  EXPECT_NE(fixed.bytes.find(R"(["smile","target_1","target_2"])"), std::string::npos)
      << fixed.bytes.substr(0, 2000);
}

// Nodes of which the first is animated.
void moving(Drawn& d, const std::vector<std::string>& names) {
  for (const std::string& name : names) {
    Json node{{"mesh", d.mesh(d.shape(1))}};
    if (!name.empty()) node["name"] = name;
    d.root(node);
  }
  const std::size_t input =
      d.made.accessor("SCALAR", 5126, 2, packed<float>({0, 1}), {{"min", {0}}, {"max", {1}}});
  const std::size_t output = d.values("VEC3", std::vector<Point>{{0, 0, 0}, d.point(2)});
  d.made.add(
      "animations",
      {{"samplers", {{{"input", input}, {"output", output}}}},
       {"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", "translation"}}}}}}});
}

TEST(NodeNames, OfMovingNodesAreNotShared) {
  expect_found("NODE_NAME_REPEATED", "/nodes/",
               {
                   [](Drawn& d) {
                     moving(d, {"arm", "arm"});
                   },
                   [](Drawn& d) {
                     std::vector<std::string> all = names(some(d, 2));
                     all.front() = "arm";
                     all.back() = "arm";
                     moving(d, all);
                   },
                   // Two joints.
                   [](Drawn& d) {
                     d.root_with(d.shape(1));
                     const std::size_t count = some(d, 2);
                     Json joints = Json::array();
                     Json below = Json::array();
                     for (std::size_t i = 0; i < count; ++i) {
                       joints.push_back(d.made.add("nodes", {{"name", "bone"}}));
                       below.push_back(joints.back());
                     }
                     d.root({{"name", "armature"}, {"children", below}});
                     d.made.add("skins", {{"joints", joints}});
                   },
               });
  expect_silent({
                    [](Drawn& d) { moving(d, names(some(d, 1))); },
                    [](Drawn& d) {
                      moving(d, {"arm", "leg", "leg"});
                    },
                    [](Drawn& d) {
                      moving(d, {"", "", "leg"});
                    },
                    [](Drawn& d) {
                      for (std::size_t i = some(d, 2); i > 0; --i) {
                        d.root({{"mesh", d.mesh(d.shape(1))}, {"name", "rock"}});
                      }
                    },
                },
                {"DUPLICATE_ACCESSORS", "TRIANGLES_COINCIDE"});
}

}  // namespace
}  // namespace gltfx::test
