// SPDX-License-Identifier: Apache-2.0
// Fixes of bounding volumes: which shape they change, and what they keep.
#include <gltfx/pipeline.hpp>

#include <set>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "model/packed_bytes.hpp"
#include "support/asset_builder.hpp"

namespace gltfx::test {
namespace {

constexpr const char* kSmallVolume = "BOUNDING_VOLUME_TOO_SMALL";

/// A triangle with the corners (0, 0, 0), (4, 0, 1) and (0, 2, 1); mesh 0.
struct FixedScene : AssetBuilder {
  explicit FixedScene(const std::string& nodes, const std::string& shapes) {
    json["asset"]["version"] = "2.1";
    json["scene"] = 0;
    json["scenes"] = AssetBuilder::Json::array({{{"nodes", {0}}}});
    json["nodes"] = AssetBuilder::Json::parse(nodes);
    json["shapes"] = AssetBuilder::Json::parse(shapes);
    accessor("VEC3", 5126, 3, floats({0, 0, 0, 4, 0, 1, 0, 2, 1}),
             {{"min", {0, 0, 0}}, {"max", {4, 2, 1}}});
    add("meshes",
        {{"primitives", AssetBuilder::Json::array({{{"attributes", {{"POSITION", 0}}}}})}});
  }
  AssetBuilder::Json fixed(bool unsafe = false) const {
    FixOptions options;
    options.only = {kSmallVolume, "BOUNDING_VOLUME_MISSES_POSES"};
    options.unsafe = unsafe;
    return AssetBuilder::Json::parse(fix_bytes({text(buffer_uri(bytes)), "test"}, options).bytes);
  }
};

TEST(FixVolumes, TheSizeIsThatOfTheGeometry) {
  const AssetBuilder::Json fixed =
      FixedScene(R"([{"mesh": 0, "boundingVolume": {"shape": 0, "extras": {"a": 1},
    "scale": [2, 2, 2]}}])",
                 R"([{"type": "box", "name": "hull", "box": {"size": [1, 1, 1]}}])")
          .fixed();
  EXPECT_EQ(fixed["shapes"].dump(), R"([{"type":"box","name":"hull","box":{"size":[4,2,1]}}])");
  EXPECT_EQ(fixed["nodes"][0]["boundingVolume"].dump(),
            R"({"shape":0,"extras":{"a":1},"translation":[2,1,0.5]})");
}

TEST(FixVolumes, ASphereStaysASphere) {
  const AssetBuilder::Json fixed =
      FixedScene(R"([{"mesh": 0, "boundingVolume": {"shape": 0}}])", R"([{"type": "sphere"}])")
          .fixed();
  EXPECT_EQ(fixed["nodes"][0]["boundingVolume"]["translation"], AssetBuilder::Json({2, 1, 0.5}));
  // Of the corners, two are as far from the middle of the box.
  EXPECT_NEAR(fixed["shapes"][0]["sphere"]["radius"].get<double>(), 2.2912878, 1e-6);
}

TEST(FixVolumes, TheRotationStays) {
  const AssetBuilder::Json fixed = FixedScene(R"([{"mesh": 0, "boundingVolume": {"shape": 0,
    "rotation": [0, 0, 0.7071068, 0.7071068]}}])",
                                              R"([{"type": "box"}])")
                                       .fixed();
  EXPECT_EQ(fixed["nodes"][0]["boundingVolume"]["rotation"].dump(), "[0,0,0.7071068,0.7071068]");
  const AssetBuilder::Json size = fixed["shapes"][0]["box"]["size"];
  EXPECT_NEAR(size[0].get<double>(), 2, 1e-5);
  EXPECT_NEAR(size[1].get<double>(), 4, 1e-5);
}

TEST(FixVolumes, AShapeThatOthersUseIsNotChanged) {
  const AssetBuilder::Json fixed = FixedScene(R"([{"children": [1, 2]},
    {"mesh": 0, "boundingVolume": {"shape": 0}},
    {"mesh": 0, "boundingVolume": {"shape": 0}, "translation": [9, 0, 0]}])",
                                              R"([{"type": "box"}])")
                                       .fixed();
  EXPECT_EQ(fixed["shapes"][0].dump(), R"({"type":"box"})");
  ASSERT_EQ(fixed["shapes"].size(), 3U);
  EXPECT_EQ(fixed["shapes"][2]["box"]["size"], AssetBuilder::Json({4, 2, 1}));
  EXPECT_EQ(fixed["nodes"][1]["boundingVolume"]["shape"], 1);
  EXPECT_EQ(fixed["nodes"][2]["boundingVolume"]["shape"], 2);
}

TEST(FixVolumes, WhatMovesIsFixedOnlyWhereThatIsAllowed) {
  FixedScene scene(R"([{"children": [1], "boundingVolume": {"shape": 0}}, {"mesh": 0}])",
                   R"([{"type": "box"}])");
  const std::size_t times =
      scene.accessor("SCALAR", 5126, 2, floats({0, 1}), {{"min", {0}}, {"max", {1}}});
  const std::size_t places = scene.accessor("VEC3", 5126, 2, floats({0, 0, 0, 0, 0, 3}));
  scene.json["animations"] = AssetBuilder::Json::parse(R"([{"samplers": [{"input": 1, "output": 2}],
    "channels": [{"sampler": 0, "target": {"node": 1, "path": "translation"}}]}])");
  EXPECT_EQ(times + 1, places);
  EXPECT_EQ(scene.fixed()["shapes"].dump(), R"([{"type":"box"}])");
  const AssetBuilder::Json fixed = scene.fixed(true);
  EXPECT_EQ(fixed["shapes"][0]["box"]["size"], AssetBuilder::Json({4, 2, 4}));
  EXPECT_EQ(fixed["nodes"][0]["boundingVolume"]["translation"], AssetBuilder::Json({2, 1, 2}));
}

}  // namespace
}  // namespace gltfx::test
