// SPDX-License-Identifier: Apache-2.0
/// Extents: by construction, and properties that hold for any scene.
#include <cmath>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "measure/measured.hpp"

namespace gltfx::measure {
namespace {

using gltfx::test::AssetBuilder;
using Json = AssetBuilder::Json;
using test::measured;
using test::value;

std::string floats(const std::vector<float>& numbers) {
  return {reinterpret_cast<const char*>(numbers.data()), numbers.size() * sizeof(float)};
}

// A mesh with these points as triangles.
std::size_t add_mesh(AssetBuilder& asset, const std::vector<float>& points) {
  const std::size_t accessor = asset.accessor("VEC3", 5126, points.size() / 3, floats(points));
  return asset.add("meshes", Json{{"primitives", {{{"attributes", {{"POSITION", accessor}}}}}}});
}

double size(const Measurements& taken, const char* name) {
  return value(taken, MeasureScope::scene, name).get<double>();
}

TEST(Bounds, AreThoseOfVerticesAndNotOfBoxes) {
  // A triangle across its box: turned by 45 degrees it is flat, and the turned box is not.
  AssetBuilder asset;
  add_mesh(asset, {0, 0, 0, 1, 0, 1, 0.5F, 1, 0.5F});
  asset.add("nodes",
            Json{{"mesh", 0}, {"rotation", {0, std::sin(M_PI / 8), 0, std::cos(M_PI / 8)}}});
  asset.add("scenes", Json{{"nodes", {0}}});
  EXPECT_NEAR(size(measured(asset), "size-x"), std::sqrt(2.0), 1e-6);
  EXPECT_NEAR(size(measured(asset), "size-z"), 0, 1e-6);
}

TEST(Bounds, LeaveOutVerticesThatNothingDraws) {
  AssetBuilder asset;
  const std::size_t points =
      asset.accessor("VEC3", 5126, 4, floats({0, 0, 0, 1, 0, 0, 0, 1, 0, 100, 100, 100}));
  const std::string indices("\0\1\2", 3);
  const std::size_t order = asset.accessor("SCALAR", 5121, 3, indices);
  asset.add("meshes",
            Json{{"primitives", {{{"attributes", {{"POSITION", points}}}, {"indices", order}}}}});
  asset.add("nodes", Json{{"mesh", 0}});
  asset.add("scenes", Json{{"nodes", {0}}});
  EXPECT_EQ(size(measured(asset), "size-max"), 1);
}

TEST(Bounds, FollowTheMorphTargetsAndInstancesThatAreDrawn) {
  AssetBuilder asset;
  const std::size_t mesh = add_mesh(asset, {0, 0, 0, 1, 0, 0, 0, 1, 0});
  const std::size_t target = asset.accessor("VEC3", 5126, 3, floats({0, 0, 0, 4, 0, 0, 0, 0, 0}));
  asset.json["meshes"][mesh]["primitives"][0]["targets"] = {{{"POSITION", target}}};
  asset.add("nodes", Json{{"mesh", 0}, {"weights", {0.5}}});
  const std::size_t places = asset.accessor("VEC3", 5126, 2, floats({0, 0, 0, 0, 0, 7}));
  asset.json["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"]["TRANSLATION"] =
      places;
  asset.json["extensionsUsed"] = {"EXT_mesh_gpu_instancing"};
  asset.add("scenes", Json{{"nodes", {0}}});
  const Measurements taken = measured(asset);
  EXPECT_EQ(size(taken, "size-x"), 3);
  EXPECT_EQ(size(taken, "size-z"), 7);
  EXPECT_EQ(size(taken, "instances"), 2);
  EXPECT_EQ(size(taken, "drawn-triangles"), 2);
  EXPECT_EQ(size(taken, "draw-calls"), 1);
}

// Turning all of a scene leaves the distances of its points; the box of the turned points is known.
TEST(Bounds, AgreeWithTransformedPoints) {
  std::mt19937 random(7);
  std::uniform_real_distribution<float> number(-5, 5);
  for (int round = 0; round < 50; ++round) {
    std::vector<float> points(9 * 4);
    for (float& each : points) each = number(random);
    double x = number(random), y = number(random), z = number(random), w = number(random);
    const double length = std::sqrt(x * x + y * y + z * z + w * w);
    x /= length, y /= length, z /= length, w /= length;
    const float scale = number(random);
    AssetBuilder asset;
    add_mesh(asset, points);
    asset.add("nodes", Json{{"children", {1}}, {"scale", {scale, scale, scale}}});
    asset.add("nodes", Json{{"mesh", 0}, {"rotation", {x, y, z, w}}});
    asset.add("scenes", Json{{"nodes", {0}}});
    double least = INFINITY, most = -INFINITY;
    for (std::size_t i = 0; i < points.size(); i += 3) {
      const double turned = (1 - 2 * (y * y + z * z)) * double(points[i]) +
                            2 * (x * y - z * w) * double(points[i + 1]) +
                            2 * (x * z + y * w) * double(points[i + 2]);
      least = std::min(least, turned * double(scale));
      most = std::max(most, turned * double(scale));
    }
    const Measurements taken = measured(asset);
    EXPECT_NEAR(size(taken, "min-x"), least, 1e-4);
    EXPECT_NEAR(size(taken, "max-x"), most, 1e-4);
  }
}

TEST(Bounds, HaveAReasonWhereThereAreNone) {
  AssetBuilder asset;
  asset.add("scenes", Json{{"name", "nothing"}});
  const Measurements nothing = measured(asset);
  EXPECT_EQ(value(nothing, MeasureScope::asset, "size-x"), nullptr);
  const auto& column = *nothing.find(MeasureScope::scene, "size-x");
  const auto reason = std::get<NotMeasured>(column.values[0]).reason;
  EXPECT_EQ(nothing.reasons[reason].text, "Nothing is drawn.");
  EXPECT_FALSE(nothing.reasons[reason].fault);

  const Measurements unread = measured(std::string(
      R"({"asset": {"version": "2.0"}, "buffers": [{"byteLength": 36, "uri": "missing.bin"}],
          "bufferViews": [{"buffer": 0, "byteLength": 36}],
          "accessors": [{"bufferView": 0, "componentType": 5126, "type": "VEC3", "count": 3}],
          "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
          "nodes": [{"mesh": 0}], "scenes": [{"nodes": [0]}]})"));
  const auto& sizes = *unread.find(MeasureScope::asset, "size-x");
  EXPECT_TRUE(unread.reasons[std::get<NotMeasured>(sizes.values[0]).reason].fault);
  const auto& files = *unread.find(MeasureScope::asset, "file-size");
  EXPECT_TRUE(unread.reasons[std::get<NotMeasured>(files.values[0]).reason].fault);
}

TEST(Bounds, OfManyScenesThatShareNodesAreLimited) {
  AssetBuilder asset;
  add_mesh(asset, {0, 0, 0, 1, 0, 0, 0, 1, 0});
  for (int i = 0; i < 2000; ++i) asset.add("nodes", Json{{"mesh", 0}});
  for (int i = 0; i < 3000; ++i) asset.add("scenes", Json{{"nodes", {0}}});
  const Measurements taken = measured(asset);
  EXPECT_EQ(value(taken, MeasureScope::scene, "draw-calls", 0), 1);
  EXPECT_EQ(value(taken, MeasureScope::scene, "draw-calls", 2999), nullptr);
}

}  // namespace
}  // namespace gltfx::measure
