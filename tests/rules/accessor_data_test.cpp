// SPDX-License-Identifier: Apache-2.0
// Elements of accessors: bounds, numbers, unit vectors, colors, indices.
#include <cmath>
#include <limits>
#include <string>

#include <gtest/gtest.h>

#include "rules/data_asset.hpp"

namespace gltfx::test {
namespace {

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinity = std::numeric_limits<float>::infinity();

std::string bounds(const std::string& min, const std::string& max) {
  return R"(, "min": [)" + min + R"(], "max": [)" + max + "]";
}

std::string scalars(Component component, std::size_t count, const std::string& bytes,
                    const std::string& min, const std::string& max) {
  DataAsset asset;
  asset.accessor("SCALAR", component, count, bytes, bounds(min, max));
  return asset.text();
}

// One attribute in addition to positions without data.
std::string with_attribute(const std::string& name, const std::string& type, Component component,
                           std::size_t count, const std::string& bytes,
                           const std::string& more = {}) {
  DataAsset asset;
  asset.accessor("VEC3", kFloat, count, "", bounds("0, 0, 0", "0, 0, 0"));
  asset.accessor(type, component, count, bytes, more);
  return asset.text(mesh(R"("POSITION": 0, ")" + name + R"(": 1)", R"(, "mode": 0)"));
}

TEST(Bounds, ThatAreExactAreSilent) {
  EXPECT_EQ(about_data(scalars(kFloat, 3, floats({1, -2, 3}), "-2", "3")), Lines());
  EXPECT_EQ(about_data(scalars(kInt8, 2, packed<std::int8_t>({-128, 127}), "-128", "127")),
            Lines());
  EXPECT_EQ(
      about_data(scalars(kUint32, 2, packed<std::uint32_t>({7, 4294967295U}), "7", "4294967295")),
      Lines());
}

TEST(Bounds, AreComparedAsSinglePrecisionHasThem) {
  EXPECT_EQ(about_data(scalars(kFloat, 1, floats({0.1F}), "0.1", "0.10000000149011612")), Lines());
  EXPECT_EQ(about_data(scalars(kFloat, 1, floats({-0.0F}), "0", "0")), Lines());
  EXPECT_EQ(about_data(scalars(kFloat, 1, floats({0.1F}), "0.1", "0.10000001")),
            (Lines{"ACCESSOR_MAX_MISMATCH /accessors/0/max/0"}));
}

TEST(Bounds, OfEveryComponentTypeAreChecked) {
  const auto wrong = [](Component component, const std::string& bytes) {
    return about_data(scalars(component, 2, bytes, "2", "4"));
  };
  const Lines both{"ACCESSOR_MIN_MISMATCH /accessors/0/min/0",
                   "ACCESSOR_ELEMENT_OUT_OF_MIN_BOUND /accessors/0/min/0",
                   "ACCESSOR_MAX_MISMATCH /accessors/0/max/0",
                   "ACCESSOR_ELEMENT_OUT_OF_MAX_BOUND /accessors/0/max/0"};
  EXPECT_EQ(wrong(kInt8, packed<std::int8_t>({1, 5})), both);
  EXPECT_EQ(wrong(kUint8, packed<std::uint8_t>({1, 200})), both);
  EXPECT_EQ(wrong(kInt16, packed<std::int16_t>({-1, 300})), both);
  EXPECT_EQ(wrong(kUint16, packed<std::uint16_t>({1, 40000})), both);
  EXPECT_EQ(wrong(kUint32, packed<std::uint32_t>({1, 3000000000U})), both);
  EXPECT_EQ(wrong(kFloat, floats({1, 5})), both);
}

TEST(Bounds, TooLooseOnesHaveNothingOutside) {
  EXPECT_EQ(about_data(scalars(kUint16, 2, packed<std::uint16_t>({1, 5}), "0", "6")),
            (Lines{"ACCESSOR_MIN_MISMATCH /accessors/0/min/0",
                   "ACCESSOR_MAX_MISMATCH /accessors/0/max/0"}));
}

TEST(Bounds, EachComponentHasItsOwn) {
  DataAsset asset;
  asset.accessor("VEC3", kFloat, 2, floats({0, 1, 2, 3, 4, 5}), bounds("0, 1, 1", "3, 5, 5"));
  EXPECT_EQ(about_data(asset.text(), Profile::khronos),
            (Lines{"ACCESSOR_MIN_MISMATCH /accessors/0/min/2",
                   "ACCESSOR_MAX_MISMATCH /accessors/0/max/1"}));
}

TEST(Bounds, OfManyElementsAreFoundWhereverTheyLie) {
  for (const std::size_t place : {0U, 1U, 47U, 4079U, 4080U, 9998U, 9999U}) {
    std::vector<std::uint16_t> numbers(10000, 5);
    numbers[place] = 6;
    DataAsset asset;
    asset.accessor("SCALAR", kUint16, numbers.size(), packed(numbers), bounds("5", "5"));
    EXPECT_EQ(about_data(asset.text()).size(), 2U) << place;
    EXPECT_NE(message(asset.text(), "ACCESSOR_ELEMENT_OUT_OF_MAX_BOUND").find("1 of 10000"),
              std::string::npos);
  }
}

TEST(Bounds, PaddingOfStridesAndColumnsIsNotLookedAt) {
  DataAsset asset;
  asset.accessor("SCALAR", kFloat, 2, floats({1, 99, 2}), bounds("1", "2"), R"(, "byteStride": 8)");
  asset.accessor("MAT2", kUint8, 1, packed<std::uint8_t>({1, 2, 99, 99, 3, 4}),
                 bounds("1, 2, 3, 4", "1, 2, 3, 4"));
  EXPECT_EQ(about_data(asset.text()), Lines());
}

TEST(Bounds, ThatAreMalformedAreNotCompared) {
  EXPECT_EQ(about_data(scalars(kFloat, 1, floats({1}), "\"a\"", "1, 2")), Lines());
  EXPECT_EQ(about_data(scalars(kUint8, 1, packed<std::uint8_t>({1}), "0.5", "300")), Lines());
}

TEST(Floats, InfinitiesAndNaNAreFoundAndCounted) {
  const std::string asset = scalars(kFloat, 4, floats({1, kNaN, kInfinity, -kInfinity}), "1", "1");
  EXPECT_EQ(about_data(asset), (Lines{"ACCESSOR_INVALID_FLOAT /accessors/0 x3"}));
  EXPECT_EQ(message(asset, "ACCESSOR_INVALID_FLOAT"), "Element 1 is NaN. This is the first of 3.");
}

TEST(Floats, TheKhronosProfileListsThemAndComparesBoundsAllTheSame) {
  EXPECT_EQ(
      about_data(scalars(kFloat, 2, floats({kNaN, 1}), "1", "1"), Profile::khronos),
      (Lines{"ACCESSOR_INVALID_FLOAT /accessors/0", "ACCESSOR_MIN_MISMATCH /accessors/0/min/0",
             "ACCESSOR_MAX_MISMATCH /accessors/0/max/0"}));
  EXPECT_EQ(about_data(scalars(kFloat, 2, floats({1, kNaN}), "1", "1"), Profile::khronos),
            (Lines{"ACCESSOR_INVALID_FLOAT /accessors/0"}));
}

std::string normal(float length) {
  return with_attribute("NORMAL", "VEC3", kFloat, 1, floats({0, 0, length}));
}

TEST(Normals, MayDifferFromUnitLengthByWhatEightBitsLose) {
  EXPECT_EQ(about_data(normal(1.00673F)), Lines());
  EXPECT_EQ(about_data(normal(0.99327F)), Lines());
  EXPECT_EQ(about_data(normal(1.00675F)),
            (Lines{"ACCESSOR_VECTOR3_NON_UNIT /meshes/0/primitives/0/attributes/NORMAL"}));
  EXPECT_EQ(about_data(normal(0.99325F)).size(), 1U);
  EXPECT_EQ(about_data(normal(0)).size(), 1U);
  EXPECT_EQ(about_data(normal(1e20F)).size(), 1U);
}

TEST(Normals, AtTheToleranceDoublePrecisionDecides) {
  // The floats above and below 1 + 0.00674, and 1 - 0.00674.
  const float above = std::nextafter(1.00674F, 2.0F);
  const float below = std::nextafter(1.00674F, 0.0F);
  EXPECT_EQ(about_data(normal(below)).size(), double{below} - 1 > 0.00674 ? 1U : 0U);
  EXPECT_EQ(about_data(normal(above)).size(), double{above} - 1 > 0.00674 ? 1U : 0U);
  const float shorter = std::nextafter(0.99326F, 0.0F);
  const float longer = std::nextafter(0.99326F, 2.0F);
  EXPECT_EQ(about_data(normal(shorter)).size(), 1 - double{shorter} > 0.00674 ? 1U : 0U);
  EXPECT_EQ(about_data(normal(longer)).size(), 1 - double{longer} > 0.00674 ? 1U : 0U);
}

TEST(Normals, AMillionErrorsAreOneFinding) {
  std::vector<float> values(3000, 0.5F);
  const std::string asset = with_attribute("NORMAL", "VEC3", kFloat, 1000, packed(values));
  EXPECT_EQ(about_data(asset),
            (Lines{"ACCESSOR_VECTOR3_NON_UNIT /meshes/0/primitives/0/attributes/NORMAL x1000"}));
  EXPECT_EQ(about_data(asset, Profile::khronos).size(), 1000U);
}

TEST(Normals, ThatAreNormalizedIntegersAreConvertedFirst) {
  const std::string quantized =
      R"(, "extensionsUsed": ["KHR_mesh_quantization"], "extensionsRequired": ["KHR_mesh_quantization"])";
  const auto normals = [&](const std::string& bytes) {
    DataAsset asset;
    asset.accessor("VEC3", kFloat, 2, "", bounds("0, 0, 0", "0, 0, 0"));
    asset.accessor("VEC3", kInt8, 2, bytes, R"(, "normalized": true)", R"(, "byteStride": 4)");
    return about_data(
        asset.text(mesh(R"("POSITION": 0, "NORMAL": 1)", R"(, "mode": 0)") + quantized));
  };
  EXPECT_EQ(normals(packed<std::int8_t>({0, 0, 127, 0, -128, 0, 0})), Lines());
  EXPECT_EQ(normals(packed<std::int8_t>({0, 0, 127, 0, 0, 64, 0})),
            (Lines{"ACCESSOR_VECTOR3_NON_UNIT /meshes/0/primitives/0/attributes/NORMAL"}));
}

TEST(Normals, OfAFormatThatIsNotAllowedAreNotLookedAt) {
  EXPECT_EQ(about_data(with_attribute("NORMAL", "VEC4", kFloat, 1, floats({5, 5, 5, 5}))), Lines());
}

TEST(Tangents, HaveASignOfOne) {
  const auto tangents = [](float length, float sign) {
    return about_data(with_attribute("TANGENT", "VEC4", kFloat, 1, floats({length, 0, 0, sign})));
  };
  const std::string place = " /meshes/0/primitives/0/attributes/TANGENT";
  EXPECT_EQ(tangents(1, 1), Lines());
  EXPECT_EQ(tangents(1, -1), Lines());
  EXPECT_EQ(tangents(1, 0.9999999F), (Lines{"ACCESSOR_INVALID_SIGN" + place}));
  EXPECT_EQ(tangents(2, 1), (Lines{"ACCESSOR_VECTOR3_NON_UNIT" + place}));
  EXPECT_EQ(tangents(2, 0),
            (Lines{"ACCESSOR_VECTOR3_NON_UNIT" + place, "ACCESSOR_INVALID_SIGN" + place}));
}

TEST(Colours, OfFloatsLieWithinZeroAndOne) {
  const std::string asset =
      with_attribute("COLOR_0", "VEC3", kFloat, 2, floats({0, 1, 1.0000001F, -0.0F, -0.1F, 0.5F}));
  EXPECT_EQ(about_data(asset),
            (Lines{"ACCESSOR_NON_CLAMPED /meshes/0/primitives/0/attributes/COLOR_0 x2"}));
  EXPECT_EQ(message(asset, "ACCESSOR_NON_CLAMPED"),
            "Component 2 of element 0 is 1.0000001192092896; it must be between 0 and 1. This is "
            "the first of 2.");
}

// `indices` of a mesh of `vertices`.
std::string indexed(Component component, std::size_t vertices, std::size_t count,
                    const std::string& bytes, const std::string& more = {}) {
  DataAsset asset;
  asset.accessor("VEC3", kFloat, vertices, "", bounds("0, 0, 0", "0, 0, 0"));
  asset.accessor("SCALAR", component, count, bytes);
  return asset.text(mesh(R"("POSITION": 0)", R"(, "indices": 1)" + more));
}

TEST(Indices, LeadToVertices) {
  const std::string place = " /meshes/0/primitives/0/indices";
  EXPECT_EQ(about_data(indexed(kUint8, 3, 3, packed<std::uint8_t>({0, 1, 2}))), Lines());
  EXPECT_EQ(about_data(indexed(kUint8, 3, 3, packed<std::uint8_t>({0, 1, 3}))),
            (Lines{"ACCESSOR_INDEX_OOB" + place}));
  EXPECT_EQ(about_data(indexed(kUint16, 3, 3, packed<std::uint16_t>({0, 1, 40000}))),
            (Lines{"ACCESSOR_INDEX_OOB" + place}));
  EXPECT_EQ(about_data(indexed(kUint32, 3, 3, packed<std::uint32_t>({3000000000U, 1, 3}))),
            (Lines{"ACCESSOR_INDEX_OOB" + place + " x2"}));
}

TEST(Indices, TheGreatestOfATypeRestartsPrimitives) {
  const std::string place = " /meshes/0/primitives/0/indices";
  EXPECT_EQ(about_data(indexed(kUint8, 256, 3, packed<std::uint8_t>({0, 1, 255}))),
            (Lines{"ACCESSOR_INDEX_PRIMITIVE_RESTART" + place}));
  EXPECT_EQ(about_data(indexed(kUint16, 65536, 3, packed<std::uint16_t>({0, 1, 255}))), Lines());
  EXPECT_EQ(about_data(indexed(kUint32, 3, 3, packed<std::uint32_t>({0, 1, 4294967295U}))),
            (Lines{"ACCESSOR_INDEX_OOB" + place, "ACCESSOR_INDEX_PRIMITIVE_RESTART" + place}));
}

TEST(Indices, TrianglesWithTwoEqualCornersAreCounted) {
  for (const std::size_t triangles : {1U, 15U, 16U, 17U, 33U, 1360U, 1361U, 3000U}) {
    for (const std::size_t bad : {std::size_t{0}, triangles / 2, triangles - 1}) {
      std::vector<std::uint32_t> indices;
      for (std::uint32_t i = 0; i < triangles * 3; ++i) indices.push_back(i);
      indices[bad * 3] = indices[bad * 3 + 2];
      const std::string asset = indexed(kUint32, triangles * 3, triangles * 3, packed(indices));
      EXPECT_EQ(about_data(asset), (Lines{"ACCESSOR_INDEX_TRIANGLE_DEGENERATE "
                                          "/meshes/0/primitives/0/indices"}))
          << triangles << " " << bad;
    }
  }
}

TEST(Indices, EqualOnesOfNeighbouringTrianglesAreNoError) {
  EXPECT_EQ(about_data(indexed(kUint8, 3, 6, packed<std::uint8_t>({0, 1, 2, 2, 1, 0}))), Lines());
  EXPECT_EQ(about_data(indexed(kUint8, 3, 3, packed<std::uint8_t>({0, 1, 1}), R"(, "mode": 5)")),
            Lines());
}

TEST(Sparse, IndicesIncreaseAndLeadToElements) {
  const auto sparse = [](std::vector<std::uint8_t> indices, Profile profile) {
    DataAsset asset;
    const std::size_t place = asset.view(packed(indices));
    const std::size_t values = asset.view(std::string(indices.size() * 4, '\0'));
    asset.accessor("SCALAR", kFloat, 4, "",
                   R"(, "sparse": {"count": )" + std::to_string(indices.size()) +
                       R"(, "indices": {"componentType": 5121, "bufferView": )" +
                       std::to_string(place) + R"(}, "values": {"bufferView": )" +
                       std::to_string(values) + "}}");
    return about_data(asset.text(), profile);
  };
  const std::string order = "ACCESSOR_SPARSE_INDICES_NON_INCREASING /accessors/0/sparse";
  const std::string range = "ACCESSOR_SPARSE_INDEX_OOB /accessors/0/sparse";
  EXPECT_EQ(sparse({0, 3}, Profile::standard), Lines());
  EXPECT_EQ(sparse({1, 1, 0}, Profile::standard), (Lines{order + " x2"}));
  EXPECT_EQ(sparse({2, 4}, Profile::standard), (Lines{range}));
  EXPECT_EQ(sparse({9, 8, 1}, Profile::khronos), (Lines{range, order, range, order}));
}

TEST(Sparse, ElementsAreCheckedLikeOthers) {
  DataAsset asset;
  const std::size_t place = asset.view(packed<std::uint16_t>({1}));
  const std::size_t values = asset.view(floats({kNaN}));
  asset.accessor("SCALAR", kFloat, 3, floats({1, 2, 3}),
                 R"(, "sparse": {"count": 1, "indices": {"componentType": 5123, "bufferView": )" +
                     std::to_string(place) + R"(}, "values": {"bufferView": )" +
                     std::to_string(values) + "}}");
  EXPECT_EQ(message(asset.text(), "ACCESSOR_INVALID_FLOAT"), "Element 1 is NaN.");
}

TEST(Sparse, ClaimsOfElementsThatTakeNoBytesAreNotFollowed) {
  for (const char* count : {"4000000000", "9007199254740991", "9007199254740992"}) {
    DataAsset asset;
    const std::size_t place = asset.view(packed<std::uint8_t>({0}));
    const std::size_t values = asset.view(floats({0}));
    const std::string text = asset.text(
        R"("accessors": [{"type": "SCALAR", "componentType": 5126, "count": )" +
        std::string(count) +
        R"(, "min": [1], "max": [1], "sparse": {"count": 1, "indices": {"componentType": 5121, "bufferView": )" +
        std::to_string(place) + R"(}, "values": {"bufferView": )" + std::to_string(values) +
        "}}}]");
    EXPECT_EQ(about_data(text), (Lines{"ACCESSOR_DATA_NOT_CHECKED /accessors/0"})) << count;
    EXPECT_EQ(about_data(text, Profile::khronos), Lines()) << count;
  }
}

TEST(Data, OfAnotherFormThanItsViewIsLeftToExtensions) {
  DataAsset asset;
  asset.accessor("SCALAR", kFloat, 4, "", bounds("1", "2"));
  EXPECT_EQ(about_data(asset.text()), Lines());
}

TEST(Data, SharedByManyPrimitivesIsReportedOnceButListedForEach) {
  DataAsset asset;
  asset.accessor("VEC3", kFloat, 1, "", bounds("0, 0, 0", "0, 0, 0"));
  asset.accessor("VEC3", kFloat, 1, floats({0, 0, 2}));
  const std::string primitive = R"({"attributes": {"POSITION": 0, "NORMAL": 1}, "mode": 0})";
  const std::string text =
      asset.text(R"("meshes": [{"primitives": [)" + primitive + ", " + primitive + "]}]");
  EXPECT_EQ(about_data(text),
            (Lines{"ACCESSOR_VECTOR3_NON_UNIT /meshes/0/primitives/0/attributes/NORMAL"}));
  EXPECT_EQ(about_data(text, Profile::khronos),
            (Lines{"ACCESSOR_VECTOR3_NON_UNIT /meshes/0/primitives/0/attributes/NORMAL",
                   "ACCESSOR_VECTOR3_NON_UNIT /meshes/0/primitives/1/attributes/NORMAL"}));
}

TEST(KhronosData, OfAnUnevenStrideIsReadByWholeComponents) {
  DataAsset asset;
  asset.accessor("SCALAR", kFloat, 2, floats({1, 2, 3}), R"(, "min": [1], "max": [2])",
                 R"(, "byteStride": 6)");
  const std::string text = asset.text();
  EXPECT_EQ(about_data(text, Profile::khronos), Lines{}) << "as with a stride of 4";
  EXPECT_EQ(about_data(text), Lines{}) << "nothing that could be meant";
  DataAsset other;
  other.accessor("SCALAR", kFloat, 2, floats({1, 2, 3}), R"(, "min": [1], "max": [3])",
                 R"(, "byteStride": 6)");
  EXPECT_EQ(about_data(other.text(), Profile::khronos),
            Lines{"ACCESSOR_MAX_MISMATCH /accessors/0/max/0"});
}

TEST(KhronosData, OfADataUriIsThereWhateverItsBufferDeclares) {
  const std::string buffer = R"("buffers": [{"uri": ")" + buffer_uri(floats({5})) + "\"";
  const std::string rest = R"(}], "bufferViews": [{"buffer": 0, "byteLength": 4}], "accessors":
    [{"bufferView": 0, "componentType": 5126, "type": "SCALAR", "count": 1, "min": [4], "max": [5]}])";
  const Lines wrong{"ACCESSOR_MIN_MISMATCH /accessors/0/min/0"};
  EXPECT_EQ(about_data(asset_with(buffer + rest), Profile::khronos), wrong);
  EXPECT_EQ(about_data(asset_with(buffer + R"(, "byteLength": 0)" + rest), Profile::khronos),
            wrong);
  EXPECT_EQ(about_data(asset_with(buffer + rest)), Lines{});
}

}  // namespace
}  // namespace gltfx::test
