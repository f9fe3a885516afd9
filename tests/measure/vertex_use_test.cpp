// SPDX-License-Identifier: Apache-2.0
// Vertices that nothing uses, that repeat, and what a GPU reads of them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "measure/surface_asset.hpp"

namespace gltfx::measure {
namespace {

using gltfx::test::AssetBuilder;
using gltfx::test::floats;
using gltfx::test::packed;
using test::asset_of;
using test::Body;
using test::cube;
using test::measured;
using test::value;

using Json = AssetBuilder::Json;

nlohmann::json of_primitive(const AssetBuilder& asset, std::string_view name, std::size_t at = 0) {
  return value(measured(asset), MeasureScope::primitive, name, at);
}
nlohmann::json of_asset(const AssetBuilder& asset, std::string_view name) {
  return value(measured(asset), MeasureScope::asset, name);
}

// Four places, of which two are equal but for the sign of a zero.
const Body kRow{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, -0.0F}}, {}, 0};

AssetBuilder one_primitive(AssetBuilder asset, const Json& primitive) {
  Json mesh;
  mesh["primitives"].push_back(primitive);
  asset.add("meshes", mesh);
  return asset;
}

TEST(UnusedVertices, NoIndexRefersToThem) {
  Body body = cube();
  body.places.resize(11);
  EXPECT_EQ(of_primitive(asset_of({body}), "unused-vertices"), 3);
  body.corners.clear();
  EXPECT_EQ(of_primitive(asset_of({body}), "unused-vertices"), 0) << "without indices";
}

TEST(UnusedVertices, PrimitivesThatShareVerticesAreOne) {
  AssetBuilder asset;
  Body body = cube();
  body.places.resize(9);
  const auto places = test::add_places(asset, body);
  Json mesh;
  for (const auto& corners : {std::vector<std::uint32_t>{0, 1, 2, 2, 1, 3},
                              std::vector<std::uint32_t>{4, 5, 6, 5, 6, 7}}) {
    body.corners = corners;
    mesh["primitives"].push_back(
        {{"attributes", {{"POSITION", places}}}, {"indices", test::add_corners(asset, body)}});
  }
  asset.add("meshes", mesh);
  EXPECT_EQ(of_primitive(asset, "unused-vertices", 0), 1);
  EXPECT_EQ(of_primitive(asset, "unused-vertices", 1), 0);
  EXPECT_EQ(of_asset(asset, "unused-vertices"), 1);
}

TEST(UnusedVertices, AnIndexThatBeginsAStripIsNoVertex) {
  AssetBuilder asset;
  Body body;
  body.places.resize(256);
  const auto places = test::add_places(asset, body);
  const auto indices =
      asset.accessor("SCALAR", 5121, 7, packed<std::uint8_t>({0, 1, 2, 255, 3, 4, 5}));
  const auto made = one_primitive(
      asset, {{"attributes", {{"POSITION", places}}}, {"indices", indices}, {"mode", 5}});
  EXPECT_EQ(of_primitive(made, "unused-vertices"), 250);
}

TEST(DuplicateVertices, AreEqualInAllAttributesAndTargets) {
  AssetBuilder asset;
  const auto places = test::add_places(asset, kRow);
  Json primitive{{"attributes", {{"POSITION", places}}}, {"mode", 0}};
  EXPECT_EQ(of_primitive(one_primitive(asset, primitive), "duplicate-vertices"), 1);

  AssetBuilder other = asset;
  const auto colors = other.accessor(
      "VEC4", 5121, 4, packed<std::uint8_t>({1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 2}));
  primitive["attributes"]["COLOR_0"] = colors;
  EXPECT_EQ(of_primitive(one_primitive(other, primitive), "duplicate-vertices"), 0) << "color";

  primitive["attributes"].erase("COLOR_0");
  const auto moved = asset.accessor("VEC3", 5126, 4, floats({0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 7}));
  primitive["targets"].push_back({{"POSITION", moved}});
  EXPECT_EQ(of_primitive(one_primitive(asset, primitive), "duplicate-vertices"), 0) << "target";
}

TEST(DuplicateVertices, AttributesThatAreNotStoredAreZeros) {
  AssetBuilder asset;
  const auto places = test::add_places(asset, kRow);
  const auto zeros = asset.accessor("VEC2", 5126, 4, {});
  const auto made = one_primitive(
      asset, {{"attributes", {{"POSITION", places}, {"TEXCOORD_0", zeros}}}, {"mode", 0}});
  EXPECT_EQ(of_primitive(made, "duplicate-vertices"), 1);
}

TEST(DuplicateVertices, PrimitivesWithTheSameAttributesAreOne) {
  auto asset = asset_of({kRow});
  asset.json["meshes"][0]["primitives"].push_back(asset.json["meshes"][0]["primitives"][0]);
  EXPECT_EQ(of_primitive(asset, "duplicate-vertices", 1), 0);
  EXPECT_EQ(of_asset(asset, "duplicate-vertices"), 1);
}

TEST(DuplicateVertices, LengthsThatDifferAreAFault) {
  AssetBuilder asset;
  const auto places = test::add_places(asset, kRow);
  const auto other = asset.accessor("VEC2", 5126, 1, floats({0, 0}));
  const auto made = one_primitive(
      asset, {{"attributes", {{"POSITION", places}, {"TEXCOORD_0", other}}}, {"mode", 0}});
  const Measurements taken = measured(made);
  const auto& found = taken.find(MeasureScope::primitive, "duplicate-vertices")->values.at(0);
  EXPECT_TRUE(taken.reasons.at(std::get<NotMeasured>(found).reason).fault);
}

TEST(JointsPerVertex, CountsWeightsOfAllSets) {
  AssetBuilder asset;
  const auto places = test::add_places(asset, kRow);
  const auto few = asset.accessor(
      "VEC4", 5126, 4, floats({1, 0, 0, 0, 0.5F, 0.5F, 0, 0, 1, 0, 0, 0, 0.3F, 0.3F, 0.2F, 0}));
  const auto more = asset.accessor(
      "VEC4", 5121, 4, packed<std::uint8_t>({0, 0, 0, 0, 3, 3, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0}),
      {{"normalized", true}});
  Json primitive{{"attributes", {{"POSITION", places}, {"WEIGHTS_0", few}}}, {"mode", 0}};
  EXPECT_EQ(of_primitive(one_primitive(asset, primitive), "joints-per-vertex"), 3);
  primitive["attributes"]["WEIGHTS_1"] = more;
  EXPECT_EQ(of_primitive(one_primitive(asset, primitive), "joints-per-vertex"), 4);
  EXPECT_EQ(of_primitive(asset_of({kRow}), "joints-per-vertex"), nullptr);
}

TEST(Caches, CountWhatTrianglesRead) {
  const auto cube_asset = asset_of({cube()});
  EXPECT_NEAR(of_primitive(cube_asset, "cache-misses").get<double>(), 8.0 / 12, 1e-6);
  EXPECT_NEAR(of_primitive(cube_asset, "fetch-overhead").get<double>(), 128.0 / 96, 1e-6);
  Body soup = cube();
  soup.corners.clear();
  soup.places.resize(6);
  EXPECT_EQ(of_primitive(asset_of({soup}), "cache-misses"), 3);
  const Body strip{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}}, {}, 5};
  EXPECT_EQ(of_primitive(asset_of({strip}), "cache-misses"), 2);
  EXPECT_EQ(of_primitive(asset_of({kRow}), "cache-misses"), nullptr) << "points";
}

}  // namespace
}  // namespace gltfx::measure
