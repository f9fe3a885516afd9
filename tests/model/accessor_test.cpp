// SPDX-License-Identifier: Apache-2.0
#include "model/accessor.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "asset_text.hpp"

namespace gltfx::model {
namespace {

using test::AssetText;

TEST(Format, SizesOfElementsCountThePaddingBetweenColumnsOfMatrices) {
  struct Case {
    Format format;
    std::uint64_t size, stride;
  };
  const Case cases[] = {
      {{ElementType::scalar, ComponentType::uint8, false}, 1, 1},
      {{ElementType::vec3, ComponentType::int16, false}, 6, 6},
      {{ElementType::vec4, ComponentType::float32, false}, 16, 16},
      {{ElementType::vec3, ComponentType::float64, false}, 24, 24},
      {{ElementType::mat2, ComponentType::int8, false}, 6, 8},
      {{ElementType::mat3, ComponentType::uint8, false}, 11, 12},
      {{ElementType::mat3, ComponentType::int16, false}, 22, 24},
      {{ElementType::mat2, ComponentType::uint16, false}, 8, 8},
      {{ElementType::mat4, ComponentType::uint8, false}, 16, 16},
      {{ElementType::mat4, ComponentType::float32, false}, 64, 64},
      {{ElementType::none, ComponentType::float32, false}, 0, 0},
      {{ElementType::vec2, ComponentType::none, false}, 0, 0},
  };
  for (const Case& each : cases) {
    EXPECT_EQ(element_size(each.format), each.size) << format_text(each.format);
    EXPECT_EQ(packed_stride(each.format), each.stride) << format_text(each.format);
  }
}

TEST(Format, IsWrittenInWords) {
  EXPECT_EQ(format_text({ElementType::vec2, ComponentType::uint16, true}),
            "VEC2 of normalized UNSIGNED_SHORT");
  EXPECT_EQ(format_text({ElementType::mat4, ComponentType::float32, false}), "MAT4 of FLOAT");
}

TEST(Format, OfNothingKnownHasNoSize) {
  EXPECT_EQ(component_size(ComponentType::none), 0U);
  EXPECT_FALSE(is_core_component(ComponentType::none));
  EXPECT_FALSE(is_core_component(ComponentType::int32));
  EXPECT_TRUE(is_core_component(ComponentType::uint32));
  EXPECT_FALSE(is_integer(ComponentType::none));
  EXPECT_FALSE(is_integer(ComponentType::float64));
  EXPECT_TRUE(is_integer(ComponentType::int32));
  EXPECT_EQ(format_text({ElementType::none, ComponentType::none, false}),
            "an unknown type of unknown components");
}

TEST(ValueRange, IsThatOfTheNumbersOfItsSize) {
  struct Case {
    ComponentType type;
    double least, most;
  };
  for (const Case& each :
       {Case{ComponentType::int8, -128, 127}, Case{ComponentType::uint8, 0, 255},
        Case{ComponentType::int16, -32768, 32767}, Case{ComponentType::uint16, 0, 65535},
        Case{ComponentType::int32, -2147483648.0, 2147483647.0},
        Case{ComponentType::uint32, 0, 4294967295.0},
        Case{ComponentType::float32, -INFINITY, INFINITY}}) {
    EXPECT_EQ(value_range(each.type).least, each.least);
    EXPECT_EQ(value_range(each.type).most, each.most);
  }
}

TEST(Accessor, IsReadFromItsObject) {
  const AssetText text(R"({"bufferViews": [{}], "accessors": [{"bufferView": 0, "byteOffset": 8,
    "componentType": 5121, "normalized": true, "count": 3, "type": "VEC4", "min": [0], "max": 1,
    "sparse": {}}]})");
  const auto accessors = read_accessors(text.asset);
  ASSERT_EQ(accessors.size(), 1U);
  const Accessor& accessor = accessors[0];
  EXPECT_EQ(accessor.buffer_view, 0U);
  EXPECT_EQ(accessor.byte_offset, 8U);
  EXPECT_EQ(accessor.count, 3U);
  EXPECT_EQ(accessor.format, (Format{ElementType::vec4, ComponentType::uint8, true}));
  EXPECT_NE(accessor.min, json::kNoNode);
  EXPECT_EQ(accessor.max, json::kNoNode);
  EXPECT_NE(accessor.sparse, json::kNoNode);
}

TEST(Accessor, MalformedMembersCountAsAbsent) {
  const AssetText text(R"({"bufferViews": [{}], "accessors": [7, {"bufferView": 1, "byteOffset": -1,
    "componentType": 5127, "normalized": 1, "count": 0, "type": "VEC5", "sparse": []}]})");
  const auto accessors = read_accessors(text.asset);
  ASSERT_EQ(accessors.size(), 2U);
  EXPECT_EQ(accessors[0].node, json::kNoNode);
  const Accessor& accessor = accessors[1];
  EXPECT_FALSE(accessor.buffer_view);
  EXPECT_FALSE(accessor.byte_offset);
  EXPECT_FALSE(accessor.count);
  EXPECT_FALSE(accessor.format.known());
  EXPECT_FALSE(accessor.format.normalized);
  EXPECT_EQ(accessor.sparse, json::kNoNode);
}

TEST(Accessor, MembersOfAnotherKindCountAsAbsent) {
  const AssetText text(R"({"bufferViews": [{}], "accessors": [
    {"bufferView": "0", "componentType": 5126.5, "count": -1, "type": 3, "name": "x"},
    {"bufferView": [], "componentType": 70657, "count": 1.5, "type": null, "other": 1}]})");
  for (const Accessor& accessor : read_accessors(text.asset)) {
    EXPECT_FALSE(accessor.buffer_view);
    EXPECT_FALSE(accessor.count);
    EXPECT_EQ(accessor.format, Format());
    EXPECT_FALSE(accessor.span_size(4));
  }
}

TEST(Accessor, WithoutAFormatItHasNoSpan) {
  Accessor accessor;
  accessor.count = 3;
  EXPECT_FALSE(accessor.span_size(4));
}

TEST(Accessor, SpanEndsWithTheLastElementAndNotWithItsStride) {
  Accessor accessor;
  accessor.count = 3;
  accessor.format = {ElementType::vec3, ComponentType::float32, false};
  EXPECT_EQ(accessor.span_size(16), 44U);
  accessor.count = 1;
  EXPECT_EQ(accessor.span_size(252), 12U);
  accessor.count = std::uint64_t{1} << 53;
  EXPECT_FALSE(accessor.span_size(std::uint64_t{1} << 12));
}

TEST(Sparse, NeedsAllItsParts) {
  const AssetText text(R"({"bufferViews": [{}], "accessors": [
    {"count": 4, "componentType": 5126, "type": "VEC3", "sparse": {"count": 2,
     "indices": {"bufferView": 0, "componentType": 5123, "byteOffset": 4}, "values": {"bufferView": 0}}},
    {"sparse": {"count": 0, "indices": {"componentType": 5123}, "values": {}}},
    {"sparse": {"count": 1, "indices": {"componentType": 5121}}},
    {"sparse": {"count": 1, "values": {"bufferView": 0}}},
    {"sparse": {"indices": {"componentType": 5121}, "values": {}}}, {}]})");
  const auto accessors = read_accessors(text.asset);
  const auto sparse = read_sparse(text.asset, accessors[0]);
  ASSERT_TRUE(sparse);
  EXPECT_EQ(sparse->count, 2U);
  EXPECT_EQ(sparse->indices.byte_offset, 4U);
  EXPECT_EQ(sparse->indices.format, (Format{ElementType::scalar, ComponentType::uint16, false}));
  EXPECT_EQ(sparse->values.format, accessors[0].format);
  for (std::size_t i = 1; i < accessors.size(); ++i) {
    EXPECT_FALSE(read_sparse(text.asset, accessors[i])) << i;
  }
}

TEST(Bounds, AreSoundWhenTheTypeCanHoldThem) {
  const AssetText text(R"({"a": [0, 255], "b": [0, 256], "c": [0.5, 1], "d": [1], "e": [0, 1, 2],
    "f": ["x", 1], "g": [-1, 0], "h": [0, 1e400]})");
  const auto sound = [&](const char* member, ComponentType component) {
    return is_sound_bound(text.document, {ElementType::vec2, component, false},
                          text.document.find(0, member));
  };
  EXPECT_TRUE(sound("a", ComponentType::uint8));
  EXPECT_FALSE(sound("b", ComponentType::uint8));
  EXPECT_TRUE(sound("b", ComponentType::uint16));
  EXPECT_FALSE(sound("c", ComponentType::uint8));
  EXPECT_TRUE(sound("c", ComponentType::float32));
  EXPECT_FALSE(sound("d", ComponentType::float32));
  EXPECT_FALSE(sound("e", ComponentType::float32));
  EXPECT_FALSE(sound("f", ComponentType::float32));
  EXPECT_FALSE(sound("g", ComponentType::uint8));
  EXPECT_TRUE(sound("g", ComponentType::int8));
  EXPECT_FALSE(sound("h", ComponentType::float32));
  EXPECT_FALSE(sound("none", ComponentType::float32));
}

}  // namespace
}  // namespace gltfx::model
