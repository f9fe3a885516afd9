// SPDX-License-Identifier: Apache-2.0
// Primitives as triangles, segments and points: modes, formats, what is stored sparsely or not at
// all, and limits.
#include "model/geometry.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "model/bytes_asset.hpp"
#include "model/packed_bytes.hpp"

namespace gltfx::model {
namespace {

using test::Accessors;
using test::BytesAsset;
using test::floats;
using test::one_mesh;
using test::packed;
using testing::ElementsAre;
using testing::FloatNear;
using testing::IsEmpty;
using testing::SizeIs;

using Triangles = std::vector<Triangle>;

constexpr int kByte = 5120, kUnsignedByte = 5121, kShort = 5122, kUnsignedShort = 5123,
              kUnsignedInt = 5125, kFloat = 5126;
constexpr std::array<std::uint32_t, 1> kSetZero{0};

std::string row_of_points(int count) {
  std::vector<float> values;
  for (int i = 0; i < count; ++i) {
    values.insert(values.end(), {static_cast<float>(i), static_cast<float>(i % 2), 0});
  }
  return packed(values);
}

// Of five vertices; without indices each in turn.
Geometry assembled(int mode, const std::vector<std::uint16_t>& indices) {
  Accessors accessors;
  accessors.add("VEC3", kFloat, 5, row_of_points(5));
  std::string more = R"(, "mode": )" + std::to_string(mode);
  if (!indices.empty()) {
    accessors.add("SCALAR", kUnsignedShort, indices.size(), packed(indices));
    more += R"(, "indices": 1)";
  }
  return BytesAsset(accessors, one_mesh(R"("POSITION": 0)", more)).read().geometry;
}

Triangles triangles_of(int mode, const std::vector<std::uint16_t>& indices) {
  return assembled(mode, indices).triangles;
}

std::vector<Segment> segments_of(int mode, const std::vector<std::uint16_t>& indices) {
  return assembled(mode, indices).segments;
}

TEST(Geometry, EveryModeGivesItsTriangles) {
  EXPECT_THAT(triangles_of(4, {}), ElementsAre(Triangle{0, 1, 2}));
  EXPECT_THAT(triangles_of(4, {4, 3, 2, 0, 1, 4, 2, 2}),
              ElementsAre(Triangle{4, 3, 2}, Triangle{0, 1, 4}));
  // Every other triangle of a strip is turned, so that all show the same side.
  EXPECT_THAT(triangles_of(5, {}),
              ElementsAre(Triangle{0, 1, 2}, Triangle{2, 1, 3}, Triangle{2, 3, 4}));
  EXPECT_THAT(triangles_of(5, {4, 3, 2, 1}), ElementsAre(Triangle{4, 3, 2}, Triangle{2, 3, 1}));
  EXPECT_THAT(triangles_of(6, {}),
              ElementsAre(Triangle{0, 1, 2}, Triangle{0, 2, 3}, Triangle{0, 3, 4}));
  for (const int mode : {0, 1, 2, 3}) EXPECT_THAT(triangles_of(mode, {}), IsEmpty()) << mode;
}

TEST(Geometry, EveryModeOfLinesGivesItsSegments) {
  EXPECT_THAT(segments_of(1, {}), ElementsAre(Segment{0, 1}, Segment{2, 3}));
  EXPECT_THAT(segments_of(3, {}),
              ElementsAre(Segment{0, 1}, Segment{1, 2}, Segment{2, 3}, Segment{3, 4}));
  EXPECT_THAT(segments_of(2, {3, 1, 0}), ElementsAre(Segment{3, 1}, Segment{1, 0}, Segment{0, 3}));
  EXPECT_THAT(
      segments_of(2, {0, 1, 65535, 2, 3, 4}),
      ElementsAre(Segment{0, 1}, Segment{1, 0}, Segment{2, 3}, Segment{3, 4}, Segment{4, 2}));
  // A vertex that does not exist, and lines without length.
  EXPECT_THAT(segments_of(1, {0, 7, 1, 1, 2, 3}), ElementsAre(Segment{2, 3}));
  EXPECT_THAT(segments_of(2, {4}), IsEmpty());
  for (const int mode : {0, 4, 5, 6}) EXPECT_THAT(segments_of(mode, {}), IsEmpty()) << mode;
}

TEST(Geometry, PointsAreThoseOfTheirIndices) {
  EXPECT_THAT(assembled(0, {}).points, ElementsAre(0, 1, 2, 3, 4));
  EXPECT_THAT(assembled(0, {3, 3, 9, 0}).points, ElementsAre(3, 3, 0));
  for (const int mode : {1, 2, 3, 4, 5, 6}) {
    EXPECT_THAT(assembled(mode, {}).points, IsEmpty()) << mode;
  }
}

TEST(Geometry, TrianglesWithoutAreaOrVertexAreLeftOut) {
  EXPECT_THAT(triangles_of(4, {0, 0, 1, 0, 1, 7, 1, 2, 3}), ElementsAre(Triangle{1, 2, 3}));
  // A strip continues after them with the same orientation.
  EXPECT_THAT(triangles_of(5, {0, 1, 1, 2, 3}), ElementsAre(Triangle{1, 2, 3}));
}

TEST(Geometry, AStripBeginsAnewAtTheGreatestIndex) {
  EXPECT_THAT(triangles_of(5, {0, 1, 2, 65535, 2, 3, 4}),
              ElementsAre(Triangle{0, 1, 2}, Triangle{2, 3, 4}));
  EXPECT_THAT(triangles_of(6, {0, 1, 2, 65535, 4, 3, 2, 1}),
              ElementsAre(Triangle{0, 1, 2}, Triangle{4, 3, 2}, Triangle{4, 2, 1}));
}

TEST(Geometry, IndicesOfEverySize) {
  for (const int type : {kUnsignedByte, kUnsignedShort, kUnsignedInt}) {
    Accessors accessors;
    accessors.add("VEC3", kFloat, 3, row_of_points(3));
    accessors.add("SCALAR", type, 3,
                  type == kUnsignedByte    ? packed<std::uint8_t>({2, 1, 0})
                  : type == kUnsignedShort ? packed<std::uint16_t>({2, 1, 0})
                                           : packed<std::uint32_t>({2, 1, 0}));
    const BytesAsset asset(accessors, one_mesh(R"("POSITION": 0)", R"(, "indices": 1)"));
    EXPECT_THAT(asset.read().geometry.triangles, ElementsAre(Triangle{2, 1, 0})) << type;
  }
}

TEST(Geometry, QuantizedAttributesAreNumbers) {
  Accessors accessors;
  const std::string normalized = R"(, "normalized": true)";
  accessors.add("VEC3", kShort, 3, packed<std::int16_t>({-2, 0, 7, 300, 4, 5, 6, 7, -32768}));
  accessors.add("VEC3", kByte, 3, packed<std::int8_t>({127, 0, 0, 0, -128, 0, 0, 0, 127}),
                normalized);
  accessors.add("VEC2", kUnsignedByte, 3, packed<std::uint8_t>({0, 255, 51, 1, 2, 3}), normalized);
  accessors.add("VEC3", kUnsignedShort, 3,
                packed<std::uint16_t>({65535, 0, 13107, 0, 0, 0, 65535, 65535, 65535}), normalized);
  const BytesAsset asset(accessors,
                         one_mesh(R"("POSITION": 0, "NORMAL": 1, "TEXCOORD_0": 2, "COLOR_0": 3)"));
  const auto read = asset.read({kSetZero, {}, {}});
  ASSERT_EQ(read.error, GeometryError::none);
  EXPECT_THAT(read.geometry.positions[0], ElementsAre(-2, 0, 7));
  EXPECT_THAT(read.geometry.positions[2], ElementsAre(6, 7, -32768));
  EXPECT_THAT(read.geometry.normals[1], ElementsAre(0, -1, 0));
  EXPECT_THAT(read.geometry.tex_coords[0][0], ElementsAre(0, 1));
  EXPECT_THAT(read.geometry.tex_coords[0][1],
              ElementsAre(FloatNear(0.2F, 1e-6F), FloatNear(1.0F / 255, 1e-6F)));
  EXPECT_THAT(read.geometry.colors[0], ElementsAre(1, 0, FloatNear(0.2F, 1e-6F), 1));
}

TEST(Geometry, SparseElementsReplaceThoseBelow) {
  Accessors accessors;
  const int indices = accessors.add_view(packed<std::uint16_t>({1}));
  const int values = accessors.add_view(floats({5, 6, 7}));
  const std::string sparse =
      R"(, "sparse": {"count": 1, "indices": {"bufferView": )" + std::to_string(indices) +
      R"(, "componentType": 5123}, "values": {"bufferView": )" + std::to_string(values) + "}}";
  accessors.add("VEC3", kFloat, 3, row_of_points(3), sparse);
  const BytesAsset asset(accessors, one_mesh(R"("POSITION": 0)"));
  EXPECT_THAT(asset.read().geometry.positions,
              ElementsAre(ElementsAre(0, 0, 0), ElementsAre(5, 6, 7), ElementsAre(2, 0, 0)));
}

TEST(Geometry, AttributesWithoutBytesAreZeros) {
  Accessors accessors;
  accessors.add("VEC3", kFloat, 3, row_of_points(3));
  accessors.add_plain(R"({"type": "VEC2", "componentType": 5126, "count": 3})");
  accessors.add_plain(R"({"type": "VEC2", "componentType": 5126, "count": 9000000000})");
  const BytesAsset asset(accessors, one_mesh(R"("POSITION": 0, "TEXCOORD_0": 1, "TEXCOORD_1": 2)"));
  constexpr std::array<std::uint32_t, 3> kSets{0, 1, 7};
  const auto read = asset.read({kSets, {}, {}});
  ASSERT_THAT(read.geometry.tex_coords, SizeIs(3));
  EXPECT_THAT(read.geometry.tex_coords[0], SizeIs(3));
  EXPECT_THAT(read.geometry.tex_coords[1], IsEmpty());
  EXPECT_THAT(read.geometry.tex_coords[2], IsEmpty());
}

TEST(Geometry, PositionsThatNobodyStoredAreNotDrawn) {
  Accessors accessors;
  accessors.add_plain(R"({"type": "VEC3", "componentType": 5126, "count": 9007199254740992})");
  const BytesAsset asset(accessors, one_mesh(R"("POSITION": 0)"));
  EXPECT_EQ(asset.read().error, GeometryError::no_positions);
}

TEST(Geometry, IndicesThatCannotBeReadAreNoTriangles) {
  Accessors accessors;
  accessors.add("VEC3", kFloat, 3, row_of_points(3));
  accessors.add("SCALAR", kFloat, 3, floats({0, 1, 2}));
  const BytesAsset asset(accessors, R"("meshes": [{"primitives": [
      {"attributes": {"POSITION": 0}, "indices": 1}]}])");
  EXPECT_EQ(asset.read().error, GeometryError::no_indices);
}

TEST(Geometry, AFewSparseElementsDoNotBuyMemory) {
  Accessors accessors;
  const int indices = accessors.add_view(packed<std::uint16_t>({1}));
  const int values = accessors.add_view(floats({5, 6, 7}));
  for (const char* count : {"4000000000", "9007199254740991"}) {
    accessors.add_plain(
        R"({"type": "VEC3", "componentType": 5126, "count": )" + std::string(count) +
        R"(, "sparse": {"count": 1, "indices": {"bufferView": )" + std::to_string(indices) +
        R"(, "componentType": 5123}, "values": {"bufferView": )" + std::to_string(values) + "}}}");
  }
  EXPECT_EQ(BytesAsset(accessors, one_mesh(R"("POSITION": 0)")).read().error,
            GeometryError::too_large);
  EXPECT_EQ(BytesAsset(accessors, one_mesh(R"("POSITION": 1)")).read().error,
            GeometryError::too_large);
}

TEST(Geometry, TheBudgetCountsAllThatIsRead) {
  Accessors accessors;
  accessors.add("VEC3", kFloat, 3, row_of_points(3));
  const BytesAsset asset(accessors, one_mesh(R"("POSITION": 0)"));
  constexpr std::uint64_t kNeeded = 3 * 12 + 3 * sizeof(Triangle);
  EXPECT_EQ(asset.read({}, kNeeded).error, GeometryError::none);
  EXPECT_EQ(asset.read({}, kNeeded - 1).error, GeometryError::too_large);
}

TEST(Geometry, AttributesOfAnotherLengthAreLeftOut) {
  Accessors accessors;
  accessors.add("VEC3", kFloat, 3, row_of_points(3));
  accessors.add("VEC3", kFloat, 2, row_of_points(2));
  const BytesAsset asset(accessors, one_mesh(R"("POSITION": 0, "NORMAL": 1)"));
  EXPECT_THAT(asset.read().geometry.normals, IsEmpty());
}

TEST(Geometry, TrianglesAtInfinityAreLeftOut) {
  Accessors accessors;
  const float infinity = std::numeric_limits<float>::infinity();
  accessors.add("VEC3", kFloat, 4, floats({0, 0, 0, 1, 0, 0, 0, 1, 0, infinity, 0, 0}));
  const BytesAsset strip(accessors, one_mesh(R"("POSITION": 0)", R"(, "mode": 5)"));
  EXPECT_THAT(strip.read().geometry.triangles, ElementsAre(Triangle{0, 1, 2}));
}

TEST(Geometry, TangentsNeedNormals) {
  Accessors accessors;
  accessors.add("VEC3", kFloat, 3, row_of_points(3));
  accessors.add("VEC4", kFloat, 3, floats({2, 0, 0, 1, 0, 3, 0, -1, 1, 0, 0, 1}));
  accessors.add("VEC3", kFloat, 3, floats({0, 0, 2, 0, 0, 1, 0, 0, 0}));
  const BytesAsset flat(accessors, one_mesh(R"("POSITION": 0, "TANGENT": 1)"));
  EXPECT_THAT(flat.read().geometry.tangents, IsEmpty());
  const BytesAsset smooth(accessors, one_mesh(R"("POSITION": 0, "TANGENT": 1, "NORMAL": 2)"));
  const auto read = smooth.read();
  EXPECT_THAT(read.geometry.tangents[0], ElementsAre(1, 0, 0, 1));
  EXPECT_THAT(read.geometry.tangents[1], ElementsAre(0, 1, 0, -1));
  EXPECT_THAT(read.geometry.normals,
              ElementsAre(ElementsAre(0, 0, 1), ElementsAre(0, 0, 1), ElementsAre(0, 0, 0)));
}

}  // namespace
}  // namespace gltfx::model
