// SPDX-License-Identifier: Apache-2.0
// Vertices that are equal bit by bit are merged.
#include <gmock/gmock.h>

#include "made_asset.hpp"

namespace gltfx {
namespace {

using test::MadeAsset;
using test::numbers_of;
using test::OrderedJson;
using test::StoredAsset;
using testing::Each;
using testing::ElementsAre;
using testing::ElementsAreArray;
using testing::IsEmpty;

ConvertOptions weld_options() {
  ConvertOptions options;
  options.weld = true;
  return options;
}

// `quads` adjacent squares; each has two triangles with separate corners.
std::vector<float> strip_of(int quads) {
  std::vector<float> positions;
  for (int i = 0; i < quads; ++i) {
    const auto x = static_cast<float>(i);
    for (const auto& [dx, y] :
         {std::pair{0.F, 0.F}, {1.F, 0.F}, {0.F, 1.F}, {0.F, 1.F}, {1.F, 0.F}, {1.F, 1.F}})
      positions.insert(positions.end(), {x + dx, y, 0});
  }
  return positions;
}

class Weld : public test::ConvertMade {
 protected:
  Weld() : ConvertMade(weld_options()) {}

  // The corners of a primitive: the values of an attribute in the order of its indices.
  static std::vector<double> corners(const StoredAsset& asset, const OrderedJson& primitive,
                                     const std::string& attribute, std::size_t width) {
    const auto values = numbers_of(asset, primitive["attributes"][attribute]);
    std::vector<double> all;
    if (!primitive.contains("indices")) return values;
    for (const double index : numbers_of(asset, primitive["indices"])) {
      for (std::size_t k = 0; k < width; ++k)
        all.push_back(values.at(static_cast<std::size_t>(index) * width + k));
    }
    return all;
  }
};

TEST_F(Weld, AddsMissingIndices) {
  MadeAsset made;
  const auto positions = strip_of(40);
  made.mesh({{"attributes", {{"POSITION", made.accessor(positions, "VEC3", true)}}},
             {"extras", {{"kept", 1}}}});
  const StoredAsset now = converted_twice(made.glb());
  const OrderedJson json = now.json();
  const OrderedJson& primitive = json["meshes"][0]["primitives"][0];
  EXPECT_EQ(primitive["indices"], 1);
  EXPECT_EQ(json["accessors"][1].dump(),
            R"({"bufferView":1,"componentType":5123,"count":240,"type":"SCALAR"})");
  EXPECT_EQ(json["bufferViews"][1]["target"], 34963);
  EXPECT_EQ(json["accessors"][0]["count"], 82);
  EXPECT_EQ(json["accessors"][0]["max"].dump(), "[40.0,1.0,0.0]");
  EXPECT_THAT(corners(now, primitive, "POSITION", 3), ElementsAreArray(positions));
  EXPECT_EQ(row_.what, "158 vertices merged in 1 primitive");
  EXPECT_THAT(row_.left, IsEmpty());
  EXPECT_LT(row_.bytes_after, row_.bytes_before);
  EXPECT_EQ(primitive["extras"]["kept"], 1);
}

TEST_F(Weld, KeepsTheTypeAndOrderOfIndices) {
  MadeAsset made;
  const std::vector<float> positions{5, 5, 5, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 1, 0};
  const std::size_t at = made.accessor(positions, "VEC3", true);
  const std::size_t indices = made.accessor<std::uint8_t>({3, 2, 4, 4, 1, 0}, "SCALAR", true);
  made.mesh({{"attributes", {{"POSITION", at}}}, {"indices", indices}});
  const StoredAsset now = converted_twice(made.glb());
  EXPECT_THAT(numbers_of(now, at), ElementsAre(5, 5, 5, 0, 0, 0, 1, 0, 0, 0, 1, 0));
  EXPECT_THAT(numbers_of(now, indices), ElementsAre(1, 2, 3, 3, 1, 0));
  EXPECT_EQ(
      now.json()["accessors"][indices].dump(),
      R"({"bufferView":1,"componentType":5121,"count":6,"type":"SCALAR","min":[0],"max":[3]})");
  EXPECT_EQ(row_.what, "1 vertex merged in 1 primitive");
}

TEST_F(Weld, ComparesEveryBitOfEveryAttribute) {
  MadeAsset made;
  const std::vector<float> same(12, 1);
  const std::size_t position = made.accessor(same, "VEC3", true);
  const std::size_t zeros = made.accessor<float>({0, -0.F, 0, 0}, "SCALAR");
  const std::size_t target =
      made.accessor<float>({0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0}, "VEC3", true);
  const std::size_t indices = made.accessor<std::uint16_t>({0, 1, 2, 1, 3, 2}, "SCALAR");
  made.mesh({{"attributes", {{"POSITION", position}, {"_ZERO", zeros}}},
             {"targets", {{{"POSITION", target}}}},
             {"indices", indices}});
  const StoredAsset now = converted_twice(made.glb());
  // Only the last one equals the first one.
  EXPECT_THAT(numbers_of(now, indices), ElementsAre(0, 1, 2, 1, 0, 2));
  EXPECT_THAT(numbers_of(now, target), ElementsAre(0, 0, 0, 0, 0, 0, 1, 0, 0));
  EXPECT_THAT(numbers_of(now, position), Each(1));
  EXPECT_EQ(now.json()["accessors"][zeros]["count"], 3);
}

TEST_F(Weld, KeepsAttributesInterleaved) {
  MadeAsset made;
  std::vector<float> records;
  for (const float x : {0.F, 1.F, 2.F, 1.F}) records.insert(records.end(), {x, 0, 0, x, 7});
  made.accessor(records, "SCALAR");
  made.json["bufferViews"][0]["byteStride"] = 20;
  OrderedJson& accessors = made.json["accessors"];
  accessors[0] = {{"bufferView", 0}, {"componentType", 5126}, {"count", 4},
                  {"type", "VEC3"},  {"min", {0, 0, 0}},      {"max", {2, 0, 0}}};
  accessors.push_back({{"bufferView", 0},
                       {"byteOffset", 12},
                       {"componentType", 5126},
                       {"count", 4},
                       {"type", "VEC2"}});
  const std::size_t indices = made.accessor<std::uint32_t>({0, 3, 2, 2, 1, 0}, "SCALAR");
  made.mesh({{"attributes", {{"POSITION", 0}, {"TEXCOORD_0", 1}}}, {"indices", indices}});
  const StoredAsset now = converted_twice(made.glb());
  EXPECT_EQ(now.json()["bufferViews"].size(), 2U);
  EXPECT_EQ(now.json()["bufferViews"][0]["byteStride"], 20);
  EXPECT_EQ(now.json()["bufferViews"][0]["byteLength"], 60);
  EXPECT_THAT(numbers_of(now, 1), ElementsAre(0, 7, 1, 7, 2, 7));
  EXPECT_THAT(numbers_of(now, indices), ElementsAre(0, 1, 2, 2, 1, 0));
}

TEST_F(Weld, UpdatesPrimitivesThatShareVerticesTogether) {
  MadeAsset made;
  const std::size_t at = made.accessor<float>({0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 1, 0}, "VEC3", true);
  const std::size_t a = made.accessor<std::uint16_t>({0, 1, 3}, "SCALAR");
  const std::size_t b = made.accessor<std::uint16_t>({2, 3, 1}, "SCALAR");
  made.mesh({{"attributes", {{"POSITION", at}}}, {"indices", a}});
  made.mesh({{"attributes", {{"POSITION", at}}}, {"indices", b}, {"mode", 1}});
  made.mesh({{"attributes", {{"POSITION", at}}}, {"indices", b}});
  const StoredAsset now = converted_twice(made.glb());
  EXPECT_THAT(numbers_of(now, a), ElementsAre(0, 1, 2));
  EXPECT_THAT(numbers_of(now, b), ElementsAre(0, 2, 1));
  EXPECT_EQ(row_.what, "1 vertex merged in 3 primitives");
}

TEST_F(Weld, UsesWideIndicesForManyVertices) {
  MadeAsset made;
  made.mesh({{"attributes", {{"POSITION", made.accessor(strip_of(40000), "VEC3", true)}}}});
  const StoredAsset now = converted_twice(made.glb());
  EXPECT_EQ(now.json()["accessors"][0]["count"], 80002);
  EXPECT_EQ(now.json()["accessors"][1]["componentType"], 5125);
}

TEST_F(Weld, KeepsRestartIndices) {
  MadeAsset made;
  const std::size_t at = made.accessor<float>({0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 1, 0}, "VEC3", true);
  const std::size_t indices = made.accessor<std::uint8_t>({0, 1, 3, 255, 2, 3, 1}, "SCALAR");
  made.mesh({{"attributes", {{"POSITION", at}}}, {"indices", indices}, {"mode", 5}});
  EXPECT_THAT(numbers_of(converted_twice(made.glb()), indices), ElementsAre(0, 1, 2, 255, 0, 2, 1));
}

// An asset with a vertex to merge, and its primitive.
struct Welded {
  Welded() {
    position = made.accessor<float>({0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 0, 0}, "VEC3", true);
    indices = made.accessor<std::uint16_t>({0, 1, 2, 3, 2, 0}, "SCALAR");
    made.mesh({{"attributes", {{"POSITION", position}}}, {"indices", indices}});
  }
  OrderedJson& primitive() { return made.json["meshes"][0]["primitives"][0]; }
  void use(const std::string& extension) { made.json["extensionsUsed"].push_back(extension); }

  MadeAsset made;
  std::size_t position, indices;
};

TEST_F(Weld, LeavesPrimitivesThatWouldBeLarger) {
  MadeAsset made;
  made.mesh({{"attributes", {{"POSITION", made.accessor(strip_of(2), "VEC3", true)}}}});
  expect_left(made, "would be larger with indices");
}

TEST_F(Weld, LeavesPointsWithoutIndices) {
  MadeAsset made;
  made.mesh(
      {{"attributes", {{"POSITION", made.accessor(strip_of(40), "VEC3", true)}}}, {"mode", 0}});
  expect_left(made, "has points without indices");
}

// Both primitives use POSITION, and each its own TEXCOORD_0.
TEST_F(Weld, MergesVerticesThatAreEqualInAllPrimitivesThatShareThem) {
  Welded a;
  const std::size_t equal = a.made.accessor(std::vector<float>(8, 0), "VEC2");
  const std::size_t other = a.made.accessor<std::uint16_t>({3, 1, 0}, "SCALAR");
  a.made.mesh(
      {{"attributes", {{"POSITION", a.position}, {"TEXCOORD_0", equal}}}, {"indices", other}});
  const StoredAsset now = converted_twice(a.made.glb());
  EXPECT_EQ(row_.what, "1 vertex merged in 2 primitives");
  EXPECT_THAT(row_.left, IsEmpty());
  for (const std::size_t each : {a.position, equal})
    EXPECT_EQ(now.json()["accessors"][each]["count"], 3);
  EXPECT_THAT(numbers_of(now, a.indices), ElementsAre(0, 1, 2, 1, 2, 0));
  EXPECT_THAT(numbers_of(now, other), ElementsAre(1, 1, 0));
}

TEST_F(Weld, KeepsVerticesThatDifferInOneOfThePrimitives) {
  Welded a;
  const std::size_t uv = a.made.accessor<float>({0, 0, 1, 0, 0, 1, 0, 1}, "VEC2");
  a.made.mesh(
      {{"attributes", {{"POSITION", a.position}, {"TEXCOORD_0", uv}}}, {"indices", a.indices}});
  const ConvertStep row = row_of(a.made.glb());
  EXPECT_FALSE(row.changes);
  EXPECT_THAT(row.left, IsEmpty());
}

TEST_F(Weld, MergesVerticesOfPrimitivesThatShareIndices) {
  Welded a;
  const std::size_t other =
      a.made.accessor<float>({5, 0, 0, 2, 0, 0, 0, 2, 0, 2, 0, 0}, "VEC3", true);
  a.made.mesh({{"attributes", {{"POSITION", other}}}, {"indices", a.indices}});
  const StoredAsset now = converted_twice(a.made.glb());
  EXPECT_THAT(numbers_of(now, a.position), ElementsAre(0, 0, 0, 1, 0, 0, 0, 1, 0));
  EXPECT_THAT(numbers_of(now, other), ElementsAre(5, 0, 0, 2, 0, 0, 0, 2, 0));
  EXPECT_THAT(numbers_of(now, a.indices), ElementsAre(0, 1, 2, 1, 2, 0));
}

TEST_F(Weld, LeavesIndicesSharedByDifferentVertices) {
  Welded a;
  const std::size_t other = a.made.accessor(std::vector<float>(15, 1), "VEC3", true);
  a.made.mesh({{"attributes", {{"POSITION", other}}}, {"indices", a.indices}});
  const ConvertStep row = row_of(a.made.glb());
  EXPECT_FALSE(row.changes);
  ASSERT_EQ(row.left.size(), 2U);
  EXPECT_EQ(row.left[0].reason, "shares its indices with primitives that have other vertices");
}

TEST_F(Weld, LeavesAccessorsWithOtherUsers) {
  Welded a;
  a.made.json["animations"] = {
      {{"samplers",
        {{{"input", a.made.accessor<float>({0, 1, 2, 3}, "SCALAR", true)},
          {"output", a.position}}}},
       {"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", "translation"}}}}}}}};
  expect_left(a.made, "shares an accessor with objects other than primitives");
}

TEST_F(Weld, LeavesUnreadableVertices) {
  Welded sparse;
  sparse.made.json["accessors"][0]["sparse"] = {
      {"count", 1},
      {"indices", {{"bufferView", 1}, {"componentType", 5123}}},
      {"values", {{"bufferView", 0}}}};
  expect_left(sparse.made, "has a sparse accessor");
  Welded outside;
  outside.made.json["accessors"][0]["count"] = 1000;
  expect_left(outside.made, "has data that cannot be read");
  Welded lengths;
  lengths.primitive()["attributes"]["_N"] = lengths.made.accessor<float>({1, 2}, "SCALAR");
  expect_left(lengths.made, "has attributes of different lengths");
  Welded nothing;
  nothing.made.json["accessors"][0].erase("bufferView");
  expect_left(nothing.made, "has an accessor without a buffer view");
  Welded broken;
  broken.primitive()["attributes"]["_N"] = 77;
  expect_left(broken.made, "has members that cannot be read");
  Welded index;
  index.primitive()["indices"] = index.made.accessor<std::uint16_t>({0, 1, 4}, "SCALAR");
  expect_left(index.made, "has an index that is out of range");
  Welded floats;
  floats.primitive()["indices"] = floats.made.accessor<float>({0, 1, 2}, "SCALAR");
  expect_left(floats.made, "has indices that are not integers");
}

TEST_F(Weld, LeavesCompressedVertices) {
  const std::string why = "is compressed; decode it first: --compress none";
  Welded draco;
  draco.use("KHR_draco_mesh_compression");
  draco.primitive()["extensions"]["KHR_draco_mesh_compression"] = {
      {"bufferView", 0}, {"attributes", {{"POSITION", 0}}}};
  expect_left(draco.made, why);
  options_.output = output().native();
  const ConvertReport report =
      convert_file(std::string(GLTFX_SOURCE_DIR) + "/fixtures/good/kelp.gltf", options_);
  ASSERT_FALSE(report.steps.empty()) << report.error;
  ASSERT_FALSE(report.steps[0].left.empty());
  EXPECT_EQ(report.steps[0].left[0].reason, why);
}

TEST_F(Weld, RefusesUnknownExtensionsOfAPrimitive) {
  Welded a;
  a.use("ACME_outline");
  a.primitive()["extensions"]["ACME_outline"]["name"] = "front";
  expect_refused(a.made, "/meshes/0/primitives/0",
                 "ACME_outline may hold indices of its vertices (describe it with --schema)");
}

TEST_F(Weld, RefusesIfIndicesAreUnknown) {
  Welded a;
  a.use("ACME_ref");
  a.made.json["nodes"][0]["extensions"]["ACME_ref"]["curve"] = 0;
  expect_refused(a.made, "",
                 "/nodes/0/extensions/ACME_ref may hold indices of accessors "
                 "(describe it with --schema)");
}

TEST_F(Weld, AllowsUnknownExtensionsWithoutNumbersElsewhere) {
  Welded a;
  a.use("ACME_tag");
  a.made.json["nodes"][0]["extensions"]["ACME_tag"]["label"] = "front";
  converted_twice(a.made.glb());
}

TEST_F(Weld, RefusesDataAboutVertices) {
  Welded outline;
  outline.use("CESIUM_primitive_outline");
  outline.primitive()["extensions"]["CESIUM_primitive_outline"]["indices"] =
      outline.made.accessor<std::uint16_t>({0, 1}, "SCALAR");
  expect_refused(outline.made, "/meshes/0/primitives/0",
                 "CESIUM_primitive_outline has data about its vertices");
  Welded features;
  features.use("EXT_mesh_features");
  features.primitive()["extensions"]["EXT_mesh_features"]["featureIds"] = {{{"featureCount", 4}}};
  expect_refused(features.made, "/meshes/0/primitives/0",
                 "EXT_mesh_features uses vertex numbers as ids");
}

TEST_F(Weld, UpdatesIdsInAnAttribute) {
  Welded a;
  a.use("EXT_mesh_features");
  a.primitive()["attributes"]["_FEATURE_ID_0"] = a.made.accessor<float>({1, 2, 3, 2}, "SCALAR");
  a.primitive()["extensions"]["EXT_mesh_features"]["featureIds"] = {
      {{"featureCount", 4}, {"attribute", 0}}};
  EXPECT_THAT(numbers_of(converted_twice(a.made.glb()), 2), ElementsAre(1, 2, 3));
}

TEST_F(Weld, AppliesTheRestWithPartial) {
  Welded a;
  a.use("ACME_outline");
  a.primitive()["extensions"]["ACME_outline"]["name"] = "front";
  const std::size_t at = a.made.accessor(std::vector<float>(9, 0), "VEC3", true);
  a.made.mesh({{"attributes", {{"POSITION", at}}},
               {"indices", a.made.accessor<std::uint16_t>({0, 1, 2}, "SCALAR")}});
  options_.partial = true;
  const ConvertReport report = run(a.made.glb());
  EXPECT_TRUE(report.written) << report.error;
  EXPECT_EQ(report.steps[0].refused.size(), 1U);
  const StoredAsset now = StoredAsset::at(output());
  EXPECT_EQ(now.json()["accessors"][a.position]["count"], 4);
  EXPECT_EQ(now.json()["accessors"][at]["count"], 1);
}

TEST_F(Weld, RunsWithShrink) {
  options_ = {};
  options_.shrink = true;
  Welded a;
  bool welded = false;
  for (const ConvertStep& step : run(a.made.glb()).steps)
    welded |= step.step == "weld" && step.changes;
  EXPECT_TRUE(welded);
}

// The bytes of the chunk are used, whatever length the buffer declares.
TEST_F(Weld, AddsAMissingLengthToABuffer) {
  for (const OrderedJson& length : {OrderedJson(), OrderedJson::array({1, 2})}) {
    Welded a;
    const StoredAsset made(a.made.glb());
    OrderedJson json = made.json();
    json["buffers"][0]["byteLength"] = length;
    if (length.is_null()) json["buffers"][0].erase("byteLength");
    const ConvertReport report = run(test::glb_of(json.dump(), made.bin));
    EXPECT_TRUE(report.written) << report.error;
    EXPECT_TRUE(report.steps[0].changes);
    const StoredAsset now = StoredAsset::at(output());
    EXPECT_EQ(now.json()["buffers"][0]["byteLength"], now.bin.size());
  }
}

// Many primitives that use the same bytes do not take unlimited time.
TEST_F(Weld, ReadsSharedBytesWithinABudget) {
  MadeAsset made;
  made.accessor(std::vector<float>(3 << 16, 0), "VEC3", true);
  const std::size_t indices = made.accessor<std::uint32_t>({0, 1, 2}, "SCALAR");
  for (int i = 0; i < 150; ++i) {
    OrderedJson& accessors = made.json["accessors"];
    accessors.push_back(accessors[0]);
    accessors.push_back(accessors[indices]);
    made.mesh(
        {{"attributes", {{"POSITION", accessors.size() - 2}}}, {"indices", accessors.size() - 1}});
  }
  const ConvertStep row = row_of(made.glb());
  ASSERT_GT(row.left.size(), 20U);
  EXPECT_EQ(row.left.back().reason, "shares its bytes with too many other objects");
}

}  // namespace
}  // namespace gltfx
