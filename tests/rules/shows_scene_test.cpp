// SPDX-License-Identifier: Apache-2.0
// What a scene shows at all, and where its vertices are.
#include <algorithm>
#include <string>
#include <string_view>

#include "measure/limit.hpp"
#include "rules/shows_assets.hpp"

namespace gltfx::test {
namespace {

Json three(double x, double y, double z) { return Json::array({x, y, z}); }

// A mesh with that material.
void with_material(Drawn& drawn, const Json& material) {
  Json primitive = drawn.primitive(drawn.shape(1));
  primitive["material"] = drawn.made.add("materials", material);
  drawn.root({{"mesh", drawn.mesh(std::move(primitive))}});
}

// A chain of nodes with the mesh at its end; one of them has the members.
void below(Drawn& drawn, const Json& members) {
  const std::size_t mesh = drawn.mesh(drawn.shape(1));
  const int length = drawn.pick(2, 5);
  const int which = drawn.pick(0, length - 1);
  for (int i = 0; i < length; ++i) {
    Json node = i == which ? members : Json{{"translation", three(drawn.number(-2, 2), 0, 1)}};
    if (i + 1 < length) node["children"] = Json::array({i + 1});
    if (i + 1 == length) node["mesh"] = mesh;
    drawn.made.add("nodes", std::move(node));
  }
  drawn.roots.push_back(0);
}

Shape collapsed(Drawn& drawn, bool line) {
  Shape shape = drawn.shape(1);
  const Point place = drawn.point(10);
  const double along = drawn.number(0.1, 2);
  for (std::size_t i = 0; i < shape.points.size(); ++i) {
    shape.points[i] = place;
    if (line) shape.points[i][1] = static_cast<float>(along * static_cast<double>(i));
  }
  return shape;
}

void use_visibility(Drawn& drawn) {
  drawn.made.json["extensionsUsed"] = Json::array({"KHR_node_visibility"});
}

const Json kHidden{{"extensions", {{"KHR_node_visibility", {{"visible", false}}}}}};

TEST(NothingVisible, IsFoundAtItsCause) {
  const std::string code = "NOTHING_VISIBLE";
  expect_found(
      code, "/meshes/0",
      {
          [](Drawn& d) { d.root_with(collapsed(d, false)); },
          [](Drawn& d) { d.root_with(collapsed(d, true)); },
          [](Drawn& d) {
            Json base{{"baseColorFactor", {d.number(0, 1), 1, d.number(0, 1), 0}}};
            with_material(d, {{"alphaMode", "BLEND"}, {"pbrMetallicRoughness", base}});
          },
          [](Drawn& d) {
            const double cutoff = d.number(0.2, 1.5);
            Json base{{"baseColorFactor", {1, 1, 1, std::min(1.0, cutoff * 0.9)}}};
            with_material(
                d,
                {{"alphaMode", "MASK"}, {"alphaCutoff", cutoff}, {"pbrMetallicRoughness", base}});
          },
          [](Drawn& d) {
            const Shape shape = d.shape(1);
            Json primitive = d.primitive(shape);
            const Four clear{static_cast<float>(d.number(0, 1)), 1, 1, 0};
            primitive["attributes"]["COLOR_0"] = d.values(
                "VEC4", std::vector<Four>(shape.points.size(), clear), {{"target", 34962}});
            primitive["material"] = d.made.add("materials", {{"alphaMode", "BLEND"}});
            d.root({{"mesh", d.mesh(std::move(primitive))}});
          },
      });
  expect_found(code, "/nodes/",
               {
                   [](Drawn& d) {
                     below(d, {{"scale", three(0, 0, 0)}});
                   },
                   [](Drawn& d) {
                     below(d, {{"scale", three(0, 2, 0)}});
                   },
                   [](Drawn& d) {
                     use_visibility(d);
                     below(d, kHidden);
                   },
               });
  expect_found(code, "/scenes/0", {[](Drawn& d) {
                 d.root_with(d.shape(1));
                 d.roots.clear();
                 if (d.pick(0, 1) == 0) d.root({{"name", "empty"}});
               }});
}

TEST(NothingVisible, IsSilentWhereSomethingIsSeen) {
  expect_silent({
      [](Drawn& d) {
        below(d, {{"scale", three(1, d.pick(0, 1) == 0 ? 0 : 1, 1e-3)}});
      },
      [](Drawn& d) {
        below(d, {{"scale", three(1, 0, 1)}});
      },
      [](Drawn& d) {
        d.root_with(collapsed(d, d.pick(0, 1) == 0));
        d.root_with(d.shape(1));
      },
      [](Drawn& d) {
        Json base{{"baseColorFactor", {1, 1, 1, d.magnitude(1e-3, 1)}}};
        with_material(d, {{"alphaMode", "BLEND"}, {"pbrMetallicRoughness", base}});
      },
      [](Drawn& d) {
        Json base{{"baseColorFactor", {1, 1, 1, 0}}};
        with_material(d, {{"pbrMetallicRoughness", base}});
      },
      [](Drawn& d) {
        use_visibility(d);
        const std::size_t mesh = d.mesh(d.shape(1));
        Json hidden = kHidden;
        hidden["mesh"] = mesh;
        d.root(hidden);
        d.root({{"mesh", mesh}});
      },
      // The first corners repeat one vertex.
      [](Drawn& d) {
        Shape shape = d.shape(1);
        shape.corners.insert(shape.corners.begin(), static_cast<std::size_t>(d.pick(20, 400)) * 3,
                             0);
        d.root_with(shape);
      },
      // It grows later.
      [](Drawn& d) {
        const std::size_t node = d.root({{"mesh", d.mesh(d.shape(1))}, {"scale", three(0, 0, 0)}});
        const std::size_t input = d.made.accessor(
            "SCALAR", 5126, 2, packed<float>({0, static_cast<float>(d.number(0.5, 3))}),
            {{"min", {0}}, {"max", {1}}});
        const std::size_t output = d.values("VEC3", std::vector<Point>{{0, 0, 0}, {1, 1, 1}});
        d.made.add(
            "animations",
            {{"samplers", {{{"input", input}, {"output", output}}}},
             {"channels", {{{"sampler", 0}, {"target", {{"node", node}, {"path", "scale"}}}}}}});
      },
  });
}

TEST(NothingVisible, IsNotSaidOfAnAssetWithErrors) {
  Drawn drawn(1);
  drawn.root_with(collapsed(drawn, false));
  drawn.made.json["asset"]["version"] = 2;
  EXPECT_TRUE(shown(drawn.text()).diagnostics.empty());
}

TEST(NothingVisible, IsAnInfoOfALibrary) {
  Drawn drawn(1);
  drawn.mesh(drawn.shape(1));
  drawn.has_scene = false;
  const FileReport report = shown(drawn.text());
  ASSERT_EQ(report.diagnostics.size(), 1U);
  EXPECT_EQ(report.diagnostics[0].code, "NOTHING_VISIBLE");
  EXPECT_EQ(report.diagnostics[0].severity, Severity::info);
}

TEST(DefaultScene, IsMissing) {
  expect_found("DEFAULT_SCENE_MISSING", "",
               {
                   [](Drawn& d) {
                     d.root_with(d.shape(1));
                     d.has_scene = false;
                   },
                   [](Drawn& d) {
                     below(d, {{"translation", three(0, d.number(0, 3), 0)}});
                     d.has_scene = false;
                   },
                   [](Drawn& d) {
                     d.root_with(d.shape(1));
                     d.has_scene = false;
                     for (int i = d.pick(1, 3); i > 0; --i) {
                       d.made.add("scenes", {{"nodes", {0}}});
                     }
                   },
               });
  expect_silent({
      [](Drawn& d) { d.root_with(d.shape(1)); },
      [](Drawn& d) {
        below(d, {{"translation", three(0, d.number(0, 3), 0)}});
      },
      [](Drawn& d) {
        d.has_scene = false;
        for (int i = d.pick(1, 4); i > 0; --i) d.root({{"name", fmt::format("joint {}", i)}});
      },
  });
}

TEST(StrayVertex, IsFound) {
  const auto put = [](Drawn& d, std::size_t count) {
    const double width = d.magnitude(1e-3, 1e3);
    Shape shape = d.shape(width);
    const double away = width * d.magnitude(300, 1e5);
    for (std::size_t i = 0; i < count; ++i) {
      const auto which =
          static_cast<std::size_t>(d.pick(0, static_cast<int>(shape.points.size()) - 1));
      shape.points[which][static_cast<std::size_t>(d.pick(0, 2))] =
          static_cast<float>(d.sign() * away);
    }
    d.root_with(shape);
  };
  expect_found("STRAY_VERTEX", "/meshes/0/primitives/0/attributes/POSITION",
               {
                   [&](Drawn& d) { put(d, 1); },
                   [&](Drawn& d) { put(d, 3); },
                   // A corner of three faces.
                   [](Drawn& d) {
                     Shape shape = d.shape(1);
                     const Point from = shape.points.front();
                     const double away = d.sign() * d.magnitude(300, 1e5);
                     for (Point& point : shape.points) {
                       if (point == from) point[0] = static_cast<float>(away);
                     }
                     d.root_with(shape);
                   },
               });
}

TEST(StrayVertex, IsNotAThinShapeNorAGroundNorTwoParts) {
  expect_silent({
      [](Drawn& d) {
        Shape shape = d.shape(1);
        const double long_side = d.magnitude(100, 1e4);
        for (Point& point : shape.points) point[0] *= static_cast<float>(long_side);
        d.root_with(shape);
      },
      [](Drawn& d) {
        Shape shape = d.shape(1);
        const auto ground = static_cast<float>(d.magnitude(200, 1e4));
        for (const float x : {-ground, ground}) {
          for (const float z : {-ground, ground}) shape.points.push_back({x, -1, z});
        }
        const auto last = static_cast<std::uint16_t>(shape.points.size() - 1);
        for (const int corner : {0, 1, 2, 2, 1, 3}) {
          shape.corners.push_back(static_cast<std::uint16_t>(last - corner));
        }
        d.root_with(shape);
      },
      [](Drawn& d) {
        Shape shape = d.shape(1);
        const Shape other = moved(shape, {d.sign() * d.magnitude(200, 1e4), 0, 0});
        const auto first = static_cast<int>(shape.points.size());
        shape.points.insert(shape.points.end(), other.points.begin(), other.points.end());
        for (const int corner : std::vector<std::uint16_t>(shape.corners)) {
          shape.corners.push_back(static_cast<std::uint16_t>(first + corner));
        }
        d.root_with(shape);
      },
      [](Drawn& d) {
        Shape shape = d.shape(1);
        shape.points.back()[2] = static_cast<float>(d.sign() * d.number(2, 40));
        d.root_with(shape);
      },
  });
}

TEST(FarPositions, AreFoundInFloats) {
  const auto away = [](Drawn& d, std::size_t axis, double steps) {
    const double width = d.magnitude(0.1, 100);
    std::array<double, 3> by{};
    // One step of single precision is 2^-23 to 2^-24 of a number.
    by[axis] = d.sign() * steps * width * 16777216 / 1000;
    d.root_with(moved(d.shape(width), by));
  };
  expect_found("POSITIONS_FAR_FROM_ORIGIN", "/meshes/0/primitives/0/attributes/POSITION",
               {
                   [&](Drawn& d) { away(d, 0, d.magnitude(2.5, 50)); },
                   [&](Drawn& d) { away(d, 2, d.magnitude(2.5, 50)); },
                   [](Drawn& d) {
                     const double width = d.number(0.5, 5);
                     d.root_with(moved(d.shape(width),
                                       {d.number(3e5, 8e5), d.number(4e6, 6e6), d.number(0, 500)}));
                   },
               });
}

TEST(FarPositions, AreFineNearerOrInANode) {
  expect_silent(
      {
          [](Drawn& d) {
            const double width = d.magnitude(0.1, 100);
            const double near = width * d.magnitude(1, 4000);
            d.root_with(moved(d.shape(width), {0, d.sign() * near, 0}));
          },
          [](Drawn& d) {
            d.root({{"mesh", d.mesh(d.shape(d.number(0.5, 5)))},
                    {"translation", three(d.number(3e5, 8e5), 120, d.number(-6e6, -4e6))}});
          },
          // A screw of a house.
          [](Drawn& d) {
            d.root_with(d.shape(d.number(20, 50)));
            d.root_with(moved(d.shape(1e-3), {d.number(15, 25), d.number(0, 5), 0}));
          },
      },
      {"PIVOT_FAR_OUTSIDE"});
}

bool says(const FileReport& report, std::string_view code) {
  return std::any_of(report.diagnostics.begin(), report.diagnostics.end(),
                     [&](const Diagnostic& each) { return each.code == code; });
}

// What is wrong with an asset explains more. What a user requires of it does not.
TEST(ShownRules, RunOnAssetsWithoutErrors) {
  Drawn drawn(1);
  drawn.root_with(collapsed(drawn, false));
  ValidateOptions options;
  options.limits = measure::read_budget("triangles=0", "test")->front().limits;
  const FileReport over = validate_bytes(drawn.text(), "test", options);
  EXPECT_TRUE(says(over, "BUDGET_TRIANGLES"));
  EXPECT_TRUE(says(over, "NOTHING_VISIBLE"));

  drawn.made.json["nodes"][0]["camera"] = 7;
  const std::string broken = drawn.text();
  EXPECT_FALSE(says(validate_bytes(broken, "test", {}), "NOTHING_VISIBLE"));
  ValidateOptions hidden;
  hidden.ignore = {"UNRESOLVED_REFERENCE"};
  EXPECT_FALSE(says(validate_bytes(broken, "test", hidden), "NOTHING_VISIBLE"));
  hidden = {};
  hidden.severity = {{"UNRESOLVED_REFERENCE", Severity::warning}};
  EXPECT_FALSE(says(validate_bytes(broken, "test", hidden), "NOTHING_VISIBLE"));
  drawn.made.json["nodes"][0]["extras"]["gltfx"]["ignore"] =
      Json::array({{{"code", "UNRESOLVED_REFERENCE"}, {"reason", "a test"}}});
  hidden = {};
  hidden.inline_suppressions = true;
  const FileReport suppressed = validate_bytes(drawn.text(), "test", hidden);
  EXPECT_FALSE(says(suppressed, "UNRESOLVED_REFERENCE"));
  EXPECT_FALSE(says(suppressed, "NOTHING_VISIBLE"));
}

}  // namespace
}  // namespace gltfx::test
