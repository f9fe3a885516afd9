// SPDX-License-Identifier: Apache-2.0
// Vertices that no index uses are removed.
#include <cmath>

#include <gmock/gmock.h>

#include "made_asset.hpp"

namespace gltfx {
namespace {

using test::MadeAsset;
using test::numbers_of;
using test::OrderedJson;
using test::StoredAsset;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

ConvertOptions vertex_options() {
  ConvertOptions options;
  options.prune = true;
  return options;
}

// Five vertices; a triangle uses 1, 3 and 4.
struct Unread {
  Unread() {
    positions = made.accessor<float>({9, 9, 9, 1, 0, 0, 8, 8, 8, 0, 2, 0, 0, 0, 3}, "VEC3", true);
    indices = made.accessor<std::uint8_t>({4, 1, 3}, "SCALAR", true);
    made.mesh({{"attributes", {{"POSITION", positions}}}, {"indices", indices}});
    made.json["scenes"] = {{{"nodes", {0}}}};
  }
  OrderedJson& primitive() { return made.json["meshes"][0]["primitives"][0]; }

  MadeAsset made;
  std::size_t positions = 0, indices = 0;
};

class PruneVertices : public test::ConvertMade {
 protected:
  PruneVertices() : ConvertMade(vertex_options()) {}
};

TEST_F(PruneVertices, KeepsTheOrderOfVerticesAndTheTypeOfIndices) {
  Unread asset;
  asset.primitive()["attributes"]["_ID"] =
      asset.made.accessor<std::uint8_t>({10, 11, 12, 13, 14}, "SCALAR");
  asset.primitive()["targets"] = {
      {{"POSITION",
        asset.made.accessor<float>({0, 0, 0, 1, 1, 1, 2, 2, 2, 3, 3, 3, 4, 4, 4}, "VEC3", true)}}};
  const StoredAsset now = converted_twice(asset.made.glb());
  EXPECT_EQ(row_.what, "2 vertices");
  EXPECT_THAT(numbers_of(now, 0), ElementsAre(1, 0, 0, 0, 2, 0, 0, 0, 3));
  EXPECT_THAT(numbers_of(now, 1), ElementsAre(2, 0, 1));
  EXPECT_THAT(numbers_of(now, 2), ElementsAre(11, 13, 14));
  EXPECT_THAT(numbers_of(now, 3), ElementsAre(1, 1, 1, 3, 3, 3, 4, 4, 4));
  const OrderedJson json = now.json();
  EXPECT_EQ(json["accessors"][0]["max"].dump(), "[1,2,3]");
  EXPECT_EQ(json["accessors"][1]["componentType"], 5121);
  EXPECT_EQ(json["accessors"][1]["max"].dump(), "[2]");
  EXPECT_EQ(json["accessors"][3]["min"].dump(), "[1,1,1]");
  EXPECT_THAT(json["bufferViews"], SizeIs(4));
}

TEST_F(PruneVertices, KeepsTheTextOfUnchangedBounds) {
  MadeAsset made;
  const std::size_t positions =
      made.accessor<float>({0.1F, 0, 0, 5, 0, 0, 0, 0.3F, 0, 0, 0, 9}, "VEC3");
  made.json["accessors"][positions]["min"] = OrderedJson::parse("[0,0.0,0e1]");
  made.json["accessors"][positions]["max"] = OrderedJson::parse("[5,0.3,9]");
  made.mesh({{"attributes", {{"POSITION", positions}}},
             {"indices", made.accessor<std::uint8_t>({0, 2, 3}, "SCALAR")}});
  made.json["scenes"] = {{{"nodes", {0}}}};
  const OrderedJson now = converted_twice(made.glb()).json();
  EXPECT_EQ(now["accessors"][positions]["min"].dump(), "[0,0.0,0.0]");
  EXPECT_THAT(now["accessors"][positions]["max"].dump(), HasSubstr("[0.1000000"));
  made.json["accessors"][positions]["max"] = OrderedJson::parse("[5,0.3,9]");
  made.json["meshes"][0]["primitives"][0]["indices"] =
      made.accessor<std::uint8_t>({1, 2, 3}, "SCALAR");
  EXPECT_EQ(converted_twice(made.glb()).json()["accessors"][positions]["max"].dump(), "[5,0.3,9]");
}

TEST_F(PruneVertices, KeepsVerticesThatOnePrimitiveUses) {
  Unread asset;
  OrderedJson second = asset.primitive();
  second["indices"] = asset.made.accessor<std::uint8_t>({0, 1, 3}, "SCALAR");
  asset.made.json["meshes"][0]["primitives"].push_back(second);
  const StoredAsset now = converted_twice(asset.made.glb());
  EXPECT_EQ(row_.what, "1 vertex");
  EXPECT_THAT(numbers_of(now, asset.indices), ElementsAre(3, 1, 2));
  EXPECT_THAT(numbers_of(now, 2), ElementsAre(0, 1, 2));
  // A primitive without indices uses all vertices.
  second.erase("indices");
  asset.made.json["meshes"][0]["primitives"].push_back(second);
  EXPECT_FALSE(row_of(asset.made.glb()).changes);
}

TEST_F(PruneVertices, IgnoresAnUnusedMesh) {
  Unread asset;
  OrderedJson second = asset.primitive();
  second.erase("indices");
  asset.made.json["meshes"].push_back({{"primitives", {second}}});
  const StoredAsset now = converted_twice(asset.made.glb());
  EXPECT_EQ(row_.what, "1 object, 2 vertices");
  EXPECT_THAT(numbers_of(now, asset.indices), ElementsAre(2, 0, 1));
}

TEST_F(PruneVertices, KeepsRestartIndices) {
  Unread asset;
  asset.primitive()["mode"] = 5;
  asset.primitive()["indices"] =
      asset.made.accessor<std::uint8_t>({4, 1, 3, 255, 3, 1, 4}, "SCALAR");
  options_.partial = true;
  const ConvertReport report = run(asset.made.glb());
  ASSERT_TRUE(report.written) << report.error;
  const StoredAsset now = StoredAsset::at(output());
  EXPECT_THAT(numbers_of(now, 1), ElementsAre(2, 0, 1, 255, 1, 0, 2));
}

// Two meshes are interleaved in one view and lose different numbers of vertices.
TEST_F(PruneVertices, RemovesViewsThatNoAccessorFits) {
  MadeAsset made;
  const std::size_t first = made.accessor<float>(
      {0, 0, 0, 1, 1, 1, 2, 2, 2, 3, 3, 3, 4, 4, 4, 5, 5, 5, 6, 6, 6, 7, 7, 7}, "VEC3");
  OrderedJson& view = made.json["bufferViews"][0];
  view["byteStride"] = 24;
  made.json["accessors"][first]["count"] = 4;
  made.json["accessors"][first]["min"] = {0, 0, 0};
  made.json["accessors"][first]["max"] = {6, 6, 6};
  OrderedJson second = made.json["accessors"][first];
  second["byteOffset"] = 12;
  second["min"] = {1, 1, 1};
  second["max"] = {7, 7, 7};
  made.json["accessors"].push_back(second);
  made.mesh({{"attributes", {{"POSITION", first}}},
             {"indices", made.accessor<std::uint8_t>({1, 2, 3}, "SCALAR")}});
  made.mesh({{"attributes", {{"POSITION", first + 1}}},
             {"mode", 1},
             {"indices", made.accessor<std::uint8_t>({1, 2}, "SCALAR")}});
  made.json["scenes"] = {{{"nodes", {0, 1}}}};
  const StoredAsset now = converted_twice(made.glb());
  EXPECT_EQ(row_.what, "3 vertices");
  EXPECT_THAT(numbers_of(now, 0), ElementsAre(2, 2, 2, 4, 4, 4, 6, 6, 6));
  EXPECT_THAT(numbers_of(now, 1), ElementsAre(3, 3, 3, 5, 5, 5));
  EXPECT_THAT(now.json()["bufferViews"], SizeIs(4));
  EXPECT_EQ(row_.left.size(), 0U);
}

TEST_F(PruneVertices, LeavesUnreadableAndSharedVertices) {
  Unread sparse;
  sparse.made.json["accessors"][0]["sparse"] = {
      {"count", 1},
      {"indices", {{"bufferView", sparse.indices}, {"componentType", 5121}}},
      {"values", {{"bufferView", sparse.positions}}}};
  expect_left(sparse.made, "has a sparse accessor");
  Unread beyond;
  beyond.primitive()["indices"] = beyond.made.accessor<std::uint8_t>({1, 3, 5}, "SCALAR");
  beyond.made.json["accessors"][beyond.indices] = beyond.made.json["accessors"][beyond.indices + 1];
  beyond.made.json["accessors"].erase(beyond.indices + 1);
  beyond.primitive()["indices"] = beyond.indices;
  beyond.made.json["bufferViews"].erase(2);
  beyond.made.json["accessors"][beyond.indices]["bufferView"] = 1;
  beyond.made.json["accessors"][beyond.indices]["componentType"] = 5123;
  beyond.made.json["accessors"][beyond.indices]["count"] = 1;
  expect_left(beyond.made, "has an index that is out of range");
}

TEST_F(PruneVertices, RemovesVerticesOfPrimitivesThatShareSomeAccessors) {
  Unread shared;
  const std::size_t normals =
      shared.made.accessor<float>({1, 0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0}, "VEC3");
  OrderedJson second = shared.primitive();
  second["attributes"]["NORMAL"] = normals;
  shared.made.json["meshes"][0]["primitives"].push_back(second);
  const StoredAsset now = converted_twice(shared.made.glb());
  EXPECT_THAT(row_.left, IsEmpty());
  EXPECT_LT(now.json()["accessors"][shared.positions]["count"], 5);
  EXPECT_EQ(now.json()["accessors"][normals]["count"],
            now.json()["accessors"][shared.positions]["count"]);
}

TEST_F(PruneVertices, ListsWhatStaysOnce) {
  Unread asset;
  asset.made.json.erase("scenes");
  asset.made.json["materials"] = {{{"name", "a"}}};
  converted_twice(asset.made.glb());
  EXPECT_EQ(row_.what, "2 vertices");
  ASSERT_THAT(row_.left, SizeIs(1));
  EXPECT_EQ(row_.left[0].pointer, "/materials");
}

// JSON has no such numbers.
TEST_F(PruneVertices, KeepsBoundsOfVerticesThatAreNotFinite) {
  Unread asset;
  std::vector<float> positions(15, 1);
  positions[3] = NAN;
  const std::size_t broken = asset.made.accessor(positions, "VEC3");
  asset.made.json["accessors"][broken]["min"] = {1, 1, 1};
  asset.made.json["accessors"][broken]["max"] = {7, 7, 7};
  asset.primitive()["attributes"]["POSITION"] = broken;
  const StoredAsset now = converted_twice(asset.made.glb());
  const OrderedJson json = now.json();
  const OrderedJson& position =
      json["accessors"]
          [json["meshes"][0]["primitives"][0]["attributes"]["POSITION"].get<std::size_t>()];
  EXPECT_EQ(position["count"], 3);
  EXPECT_EQ(position["max"].dump(), "[7,7,7]");
}

TEST_F(PruneVertices, LeavesCompressedPrimitives) {
  Unread draco;
  draco.made.json["extensionsUsed"] = {"KHR_draco_mesh_compression"};
  draco.primitive()["extensions"]["KHR_draco_mesh_compression"] = {
      {"bufferView", 0}, {"attributes", {{"POSITION", 0}}}};
  expect_left(draco.made, "is compressed; decode it first: --compress none");
}

TEST_F(PruneVertices, RefusesIfAnExtensionRefersToVertices) {
  Unread ids;
  ids.made.json["extensionsUsed"] = {"EXT_mesh_features"};
  ids.primitive()["extensions"]["EXT_mesh_features"]["featureIds"] = {{{"featureCount", 5}}};
  expect_refused(ids.made, "/meshes/0/primitives/0",
                 "EXT_mesh_features uses vertex numbers as ids");
  Unread words;
  words.made.json["extensionsUsed"] = {"ACME_words"};
  words.primitive()["extensions"]["ACME_words"]["first"] = "third";
  expect_refused(words.made, "/meshes/0/primitives/0",
                 "ACME_words may hold indices of its vertices (describe it with --schema)");
  Unread elsewhere;
  elsewhere.made.json["extensionsUsed"] = {"ACME_ref"};
  elsewhere.made.json["nodes"][0]["extensions"]["ACME_ref"]["vertex"] = 3;
  expect_refused(elsewhere.made, "/nodes/0/extensions/ACME_ref",
                 "may hold indices (describe it with --schema)");
}

}  // namespace
}  // namespace gltfx
