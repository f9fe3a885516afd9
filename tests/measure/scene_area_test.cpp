// SPDX-License-Identifier: Apache-2.0
// The area of what a scene draws.
#include <cmath>

#include <gtest/gtest.h>

#include "measure/surface_asset.hpp"

namespace gltfx::measure {
namespace {

using Json = gltfx::test::AssetBuilder::Json;
using gltfx::test::floats;
using test::cube;

// Nodes with the same cube.
gltfx::test::AssetBuilder scene_of(const std::vector<Json>& nodes) {
  auto asset = test::asset_of({cube()});
  Json scene;
  for (Json node : nodes) {
    node["mesh"] = 0;
    scene["nodes"].push_back(asset.add("nodes", node));
  }
  asset.add("scenes", scene);
  return asset;
}

double area_of(const gltfx::test::AssetBuilder& asset) {
  const auto area = test::value(test::measured(asset), MeasureScope::scene, "surface-area");
  return area.is_number() ? area.get<double>() : -1;
}

TEST(SceneArea, IsThatOfEachNodeAsItStands) {
  EXPECT_NEAR(area_of(scene_of({Json::object(), {{"translation", {5, 0, 0}}}})), 12, 1e-9);
  EXPECT_NEAR(area_of(scene_of({{{"scale", {2, 2, 2}}}, {{"scale", {-1, 1, 1}}}})), 30, 1e-9);
  // A box of 1 x 2 x 3.
  EXPECT_NEAR(area_of(scene_of({{{"scale", {1, 2, 3}}}})), 22, 1e-9);
  EXPECT_NEAR(area_of(scene_of({{{"scale", {1, 2, 3}}, {"rotation", {0.5, 0.5, 0.5, 0.5}}}})), 22,
              1e-9);
  EXPECT_NEAR(area_of(scene_of({{{"scale", {1, 1, 0}}}})), 2, 1e-9) << "flat, with two sides";
}

TEST(SceneArea, HasCopies) {
  auto asset = scene_of({Json::object()});
  const auto scales = asset.accessor("VEC3", 5126, 3, floats({1, 1, 1, 2, 2, 2, 1, 2, 3}));
  asset.json["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"]["SCALE"] = scales;
  EXPECT_NEAR(area_of(asset), 6 + 24 + 22, 1e-5);
}

TEST(SceneArea, IsNotKnownOfCopiesThatAreNowhere) {
  auto asset = scene_of({Json::object()});
  const float nan = std::nanf("");
  std::string scales;
  for (int i = 0; i < 100; ++i) {
    scales += floats({nan, static_cast<float>(i), 1, 1, 2, static_cast<float>(i)});
  }
  asset.json["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"]["SCALE"] =
      asset.accessor("VEC3", 5126, 200, scales);
  EXPECT_EQ(area_of(asset), -1);
}

TEST(SceneArea, FollowsMorphTargets) {
  auto asset = scene_of({{{"weights", {0.5}}}});
  auto moved = cube();
  for (auto& place : moved.places) place = {0, place[1] * 4, 0};  // 0.5 of it: 3 high
  const auto target = test::add_places(asset, moved);
  asset.json["meshes"][0]["primitives"][0]["targets"].push_back({{"POSITION", target}});
  EXPECT_NEAR(area_of(asset), 2 + 4 * 3, 1e-5);
  asset.json["nodes"][0].erase("weights");
  EXPECT_NEAR(area_of(asset), 6, 1e-5);
}

TEST(SceneArea, FollowsSkins) {
  auto asset = scene_of({{{"skin", 0}, {"scale", {7, 7, 7}}}});
  const std::string joints(8 * 4, '\0');
  std::string weights;
  for (int i = 0; i < 8; ++i) weights += floats({1, 0, 0, 0});
  auto& attributes = asset.json["meshes"][0]["primitives"][0]["attributes"];
  attributes["JOINTS_0"] = asset.accessor("VEC4", 5121, 8, joints);
  attributes["WEIGHTS_0"] = asset.accessor("VEC4", 5126, 8, weights);
  asset.add("nodes", {{"scale", {1, 2, 3}}});
  asset.add("skins", {{"joints", {1}}});
  EXPECT_NEAR(area_of(asset), 22, 1e-5) << "the transform of the node has no effect";
}

}  // namespace
}  // namespace gltfx::measure
