// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "selected.hpp"

namespace gltfx::test {
namespace {

const std::string kMeshPrimitive = "/meshes/0/primitives/0";

// Accessors 0 to 8 are positions, with a count of index + 1; accessor 9 has two UNSIGNED_SHORT.
std::string asset_of(const std::string& primitive, const std::string& more = {}) {
  std::string accessors;
  for (int i = 0; i < 9; ++i) {
    accessors +=
        R"({"componentType": 5126, "type": "VEC3", "min": [0, 0, 0], "max": [0, 0, 0], "count": )" +
        std::to_string(i + 1) + "}, ";
  }
  return asset_with(R"("accessors": [)" + accessors +
                    R"({"componentType": 5123, "type": "SCALAR", "count": 2})" + more +
                    R"(], "meshes": [{"primitives": [{)" + primitive + "}]}]");
}

TEST(Primitive, AllAttributesHaveTheSameCount) {
  const std::string code = "MESH_PRIMITIVE_UNEQUAL_ACCESSOR_COUNT";
  EXPECT_EQ(places(asset_of(R"("attributes": {"POSITION": 2, "NORMAL": 2})"), code), Lines{});
  EXPECT_EQ(places(asset_of(R"("attributes": {"POSITION": 2, "NORMAL": 3})"), code),
            Lines{kMeshPrimitive + "/attributes/NORMAL"});
  EXPECT_EQ(places(asset_of(R"("attributes": {"NORMAL": 3, "POSITION": 2})"), code),
            Lines{kMeshPrimitive + "/attributes/POSITION"})
      << "the first one counts";
}

// View 0 has no target, view 1 has the target of indices; both have a stride.
Lines of_indices(const std::string& accessor, Profile profile = Profile::standard) {
  return selected(
      asset_with(R"("buffers": [{"byteLength": 100}], "bufferViews": [
      {"buffer": 0, "byteLength": 100, "byteStride": 4},
      {"buffer": 0, "byteLength": 100, "byteStride": 4, "target": 34963}],
      "accessors": [{"count": 3, )" +
                 accessor +
                 R"(}], "meshes": [{"primitives": [{"attributes": {"_A": 7}, "indices": 0}]}])"),
      {"MESH_PRIMITIVE_INDICES_ACCESSOR_INVALID_FORMAT",
       "MESH_PRIMITIVE_INDICES_ACCESSOR_WITH_BYTESTRIDE"},
      profile);
}

TEST(PrimitiveIndices, ArePlainUnsignedIntegers) {
  const Lines found{"MESH_PRIMITIVE_INDICES_ACCESSOR_INVALID_FORMAT " + kMeshPrimitive +
                    "/indices"};
  for (const char* type : {"5121", "5123", "5125"}) {
    EXPECT_EQ(of_indices(std::string(R"("type": "SCALAR", "componentType": )") + type), Lines{})
        << type;
    EXPECT_EQ(of_indices(std::string(R"("type": "VEC2", "componentType": )") + type), found)
        << type;
  }
  for (const char* type : {"5120", "5122", "5126"}) {
    EXPECT_EQ(of_indices(std::string(R"("type": "SCALAR", "componentType": )") + type), found)
        << type;
  }
  EXPECT_EQ(of_indices(R"("type": "SCALAR", "componentType": 5121, "normalized": true)"), found);
}

TEST(PrimitiveIndices, HaveNoStrideAndAreToldOnce) {
  const std::string at_use =
      "MESH_PRIMITIVE_INDICES_ACCESSOR_WITH_BYTESTRIDE " + kMeshPrimitive + "/indices";
  const std::string indices = R"("type": "SCALAR", "componentType": 5121, "bufferView": )";
  EXPECT_EQ(of_indices(indices + "0"), Lines{at_use});
  EXPECT_EQ(of_indices(indices + "1"), Lines{}) << "the view itself is at fault";
  EXPECT_EQ(of_indices(indices + "1", Profile::khronos), Lines{at_use});
}

TEST(PrimitiveMode, TellsHowManyVerticesThereMayBe) {
  const std::string code = "MESH_PRIMITIVE_INCOMPATIBLE_MODE";
  // For each mode, the valid counts from 1 to 9.
  const std::vector<std::set<int>> good{
      {1, 2, 3, 4, 5, 6, 7, 8, 9}, {2, 4, 6, 8}, {2, 3, 4, 5, 6, 7, 8, 9},
      {2, 3, 4, 5, 6, 7, 8, 9},    {3, 6, 9},    {3, 4, 5, 6, 7, 8, 9},
      {3, 4, 5, 6, 7, 8, 9}};
  for (std::size_t mode = 0; mode < good.size(); ++mode) {
    for (int count = 1; count <= 9; ++count) {
      const std::string text =
          asset_of(R"("attributes": {"POSITION": )" + std::to_string(count - 1) + R"(}, "mode": )" +
                   std::to_string(mode));
      EXPECT_EQ(places(text, code), good[mode].count(count) ? Lines{} : Lines{kMeshPrimitive})
          << mode << " " << count;
    }
  }
}

TEST(PrimitiveMode, CountsIndicesWhereThereAreSome) {
  const std::string code = "MESH_PRIMITIVE_INCOMPATIBLE_MODE";
  const std::string two = R"("attributes": {"POSITION": 2}, "indices": 9)";
  EXPECT_EQ(places(asset_of(two), code), Lines{kMeshPrimitive});
  EXPECT_EQ(message(asset_of(two), code),
            "The primitive has 2 indices; for TRIANGLES it must have a multiple of 3.");
  EXPECT_EQ(places(asset_of(R"("attributes": {"POSITION": 3}, "indices": 99)"), code), Lines{})
      << "the broken index is reported";
  EXPECT_EQ(
      places(asset_of(R"("attributes": {"POSITION": 3}, "indices": 99)"), code, Profile::khronos),
      Lines{kMeshPrimitive});
  EXPECT_EQ(places(asset_of(R"("attributes": {"POSITION": 3}, "mode": 9)"), code), Lines{});
}

TEST(MorphTargets, MoveAttributesThatThePrimitiveHas) {
  const std::set<std::string, std::less<>> codes{
      "MESH_PRIMITIVE_MORPH_TARGET_NO_BASE_ACCESSOR",
      "MESH_PRIMITIVE_MORPH_TARGET_INVALID_ATTRIBUTE_COUNT"};
  const auto of_target = [&](const std::string& target) {
    return selected(
        asset_of(R"("attributes": {"POSITION": 2, "_A": 2}, "targets": [{)" + target + "}]"),
        codes);
  };
  EXPECT_EQ(of_target(R"("POSITION": 2, "_A": 2)"), Lines{});
  EXPECT_EQ(of_target(R"("NORMAL": 2)"), Lines{"MESH_PRIMITIVE_MORPH_TARGET_NO_BASE_ACCESSOR " +
                                               kMeshPrimitive + "/targets/0/NORMAL"});
  EXPECT_EQ(of_target(R"("_A": 3)"), Lines{"MESH_PRIMITIVE_MORPH_TARGET_INVALID_ATTRIBUTE_COUNT " +
                                           kMeshPrimitive + "/targets/0/_A"});
}

TEST(MorphTargets, HaveFormatsOfTheirOwn) {
  const std::string code = "MESH_PRIMITIVE_ATTRIBUTES_ACCESSOR_INVALID_FORMAT";
  const std::string more =
      R"(, {"componentType": 5120, "normalized": true, "type": "VEC4", "count": 3},
    {"componentType": 5126, "type": "VEC4", "count": 3}, {"componentType": 5125, "type": "VEC4", "count": 3})";
  const auto of_target = [&](const std::string& target) {
    return places(
        asset_of(
            R"("attributes": {"POSITION": 2, "NORMAL": 2, "TANGENT": 11, "COLOR_0": 11, "_A": 2},
      "targets": [{)" +
                target + "}]",
            more),
        code);
  };
  EXPECT_EQ(of_target(R"("TANGENT": 2, "COLOR_0": 10, "POSITION": 2)"), Lines{});
  EXPECT_EQ(of_target(R"("TANGENT": 11)"), Lines{kMeshPrimitive + "/targets/0/TANGENT"});
  EXPECT_EQ(of_target(R"("_A": 12)"), Lines{});
}

TEST(MorphTargets, PositionsHaveBoundsToo) {
  const std::string more = R"(, {"componentType": 5126, "type": "VEC3", "count": 3})";
  EXPECT_EQ(
      places(asset_of(R"("attributes": {"POSITION": 2}, "targets": [{"POSITION": 10}])", more),
             "MESH_PRIMITIVE_POSITION_ACCESSOR_WITHOUT_BOUNDS"),
      Lines{kMeshPrimitive + "/targets/0/POSITION"});
}

TEST(Primitive, CompressedGeometryRaisesNothingOfItsOwn) {
  const std::string compressed = R"({"asset": {"version": "2.0"},
    "extensionsUsed": ["KHR_draco_mesh_compression"], "extensionsRequired": ["KHR_draco_mesh_compression"],
    "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
    "buffers": [{"byteLength": 61, "uri": "data:application/octet-stream;base64,RFJBQ08CAgEAAAABAwEAAQIBAQAJAwAAAAAAAAAAAAAAAAAAAAAAgD8AAAAAAAAAAAAAAAAAAIA/AAAAAA=="}],
    "bufferViews": [{"buffer": 0, "byteLength": 61}],
    "accessors": [{"componentType": 5126, "type": "VEC3", "count": 3, "min": [0, 0, 0], "max": [1, 1, 0]},
      {"componentType": 5121, "type": "SCALAR", "count": 3}],
    "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1,
      "extensions": {"KHR_draco_mesh_compression": {"bufferView": 0, "attributes": {"POSITION": 0}}}}]}]})";
  EXPECT_EQ(verdict(compressed, Profile::strict), Lines{});
}

}  // namespace
}  // namespace gltfx::test
