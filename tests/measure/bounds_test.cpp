// SPDX-License-Identifier: Apache-2.0
/// Extents: by construction, and properties that hold for any scene.
#include <cmath>
#include <numeric>
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

std::string reason(const Measurements& taken, MeasureScope on, const char* name) {
  return taken.reasons[std::get<NotMeasured>(taken.find(on, name)->values[0]).reason].text;
}

// Sparse accessors have any number of elements for a few bytes.
std::size_t add_sparse(AssetBuilder& asset, std::size_t count, const std::vector<float>& first) {
  std::vector<std::uint8_t> numbers(first.size() / 3);
  std::iota(numbers.begin(), numbers.end(), std::uint8_t{0});
  const std::size_t indices = asset.view({numbers.begin(), numbers.end()});
  const std::size_t values = asset.view(floats(first));
  return asset.accessor("VEC3", 5126, count, "",
                        Json{{"sparse",
                              {{"count", numbers.size()},
                               {"indices", {{"bufferView", indices}, {"componentType", 5121}}},
                               {"values", {{"bufferView", values}}}}}});
}

TEST(Bounds, CopiesOfAllNodesHaveOneBudget) {
  AssetBuilder asset;
  add_mesh(asset, {0, 0, 0, 1, 0, 0, 0, 1, 0});
  const std::size_t places = add_sparse(asset, 1'500'000, {7, 0, 0});
  Json node{{"mesh", 0}};
  node["extensions"]["EXT_mesh_gpu_instancing"]["attributes"]["TRANSLATION"] = places;
  asset.add("nodes", node);
  asset.add("scenes", Json{{"nodes", {0}}});
  Request request;
  request.wanted.emplace();
  for (const Name name : {Name::instances, Name::size_x, Name::surface_area}) {
    request.wanted->push_back({MeasureScope::scene, name});
  }
  EXPECT_EQ(size(measured(asset, request), "size-x"), 8);
  asset.json["scenes"][0]["nodes"].push_back(asset.add("nodes", node));
  const Measurements two = measured(asset, request);
  EXPECT_EQ(size(two, "instances"), 3'000'000) << "to count them takes no memory";
  for (const char* name : {"size-x", "surface-area"}) {
    EXPECT_EQ(reason(two, MeasureScope::scene, name),
              "The scenes have too many copies, joints or weights.");
  }
}

TEST(Bounds, JointsOfManyScenesHaveOneBudget) {
  AssetBuilder asset;
  add_mesh(asset, {0, 0, 0, 1, 0, 0, 0, 1, 0});
  asset.add("nodes", Json{{"mesh", 0}, {"skin", 0}});
  asset.add("skins", Json{{"joints", std::vector<int>(100'000, 0)}});
  for (int i = 0; i < 40; ++i) asset.add("scenes", Json{{"nodes", {0}}});
  Request request;
  request.wanted = {{MeasureScope::scene, Name::size_x}};
  const Measurements taken = measured(asset, request);
  EXPECT_EQ(value(taken, MeasureScope::scene, "size-x", 0), 1);
  EXPECT_EQ(value(taken, MeasureScope::scene, "size-x", 39), nullptr);
}

TEST(Bounds, OfPrimitivesWithTheSameVerticesReadTheseOnce) {
  AssetBuilder asset;
  const std::size_t places = add_sparse(asset, 1'000'000, {0, 0, 0, 1, 0, 0, 0, 1, 0, 5, 5, 5});
  const std::size_t order = asset.accessor("SCALAR", 5121, 3, std::string("\0\1\2", 3));
  const Json primitive{{"attributes", {{"POSITION", places}}}, {"indices", order}};
  asset.add("meshes", Json{{"primitives", std::vector<Json>(100, primitive)}});
  asset.add("nodes", Json{{"mesh", 0}, {"rotation", {0, 0.6, 0, 0.8}}});
  asset.add("scenes", Json{{"nodes", {0}}});
  const Measurements taken = measured(asset);
  EXPECT_EQ(value(taken, MeasureScope::mesh, "size-x"), 1);
  EXPECT_NEAR(size(taken, "size-x"), 0.28, 1e-6);
  EXPECT_EQ(value(taken, MeasureScope::primitive, "cache-misses", 99), 3);
  EXPECT_TRUE(value(taken, MeasureScope::primitive, "fetch-overhead", 99).is_number());
}

TEST(Bounds, LeaveOutPrimitivesWithoutPositions) {
  AssetBuilder asset;
  add_mesh(asset, {0, 0, 0, 1, 0, 0, 0, 1, 0});
  const std::size_t target = asset.accessor("VEC3", 5126, 3, floats({0, 0, 0, 1, 0, 0, 0, 0, 0}));
  auto& primitives = asset.json["meshes"][0]["primitives"];
  primitives[0]["targets"] = {{{"POSITION", target}}};
  const std::size_t colors = asset.accessor("VEC3", 5126, 3, floats({0, 0, 0, 1, 0, 0, 0, 0, 0}));
  primitives.push_back({{"attributes", {{"COLOR_0", colors}}}});
  asset.add("nodes", Json{{"mesh", 0}, {"weights", {1}}});
  asset.add("scenes", Json{{"nodes", {0}}});
  const Measurements taken = measured(asset);
  EXPECT_EQ(value(taken, MeasureScope::mesh, "size-x"), 1);
  EXPECT_EQ(size(taken, "size-x"), 2);
  EXPECT_EQ(size(taken, "surface-area"), 1);
  EXPECT_EQ(value(taken, MeasureScope::mesh, "surface-area"), 0.5);
}

TEST(Bounds, AreUnknownWhereIndicesCannotBeRead) {
  AssetBuilder asset;
  add_mesh(asset, {0, 0, 0, 1, 0, 0, 0, 1, 0});
  asset.json["meshes"][0]["primitives"][0]["indices"] =
      asset.accessor("SCALAR", 5126, 3, floats({0, 1, 2}));
  asset.add("nodes", Json{{"mesh", 0}});
  asset.add("scenes", Json{{"nodes", {0}}});
  EXPECT_EQ(reason(measured(asset), MeasureScope::scene, "size-x"), "Vertices could not be read.");
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
