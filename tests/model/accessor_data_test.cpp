// SPDX-License-Identifier: Apache-2.0
// Elements of accessors as arrays: every component type and layout, and wrong numbers.
#include "model/accessor_data.hpp"

#include <memory>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "json/parse.hpp"
#include "model/packed_bytes.hpp"

namespace gltfx::model {
namespace {

using test::floats;
using test::packed;

// An asset with one accessor on one view of one buffer; sparse parts are views 1 and 2.
class AssetWithData {
 public:
  AssetWithData(const std::string& accessor, const std::string& views, std::string bytes) {
    auto text = share_text(R"({"accessors": [)" + accessor + R"(], "bufferViews": [)" + views +
                           R"(], "buffers": [{"byteLength": 1}]})");
    document_ = json::parse(text).document;
    asset_ = std::make_unique<Asset>(document_);
    views_ = Views(*asset_);
    resources_.buffers.emplace_back(container::Bytes::from_string(std::move(bytes)));
  }

  std::optional<AccessorData> open(Malformed malformed = Malformed::unusable) const {
    return AccessorData::open(*asset_, views_, resources_, views_.accessors[0], malformed);
  }

  // All components, or "no data" as an empty list.
  std::vector<double> values(Malformed malformed = Malformed::unusable) const {
    std::vector<double> all;
    const auto data = open(malformed);
    if (!data) return all;
    with_component_type(data->format().component, [&](auto zero) {
      using T = decltype(zero);
      data->template visit<T>([&](const T* at, std::size_t elements, std::uint64_t first) {
        EXPECT_EQ(first * data->components(), all.size());
        for (std::size_t i = 0; i < elements * data->components(); ++i) {
          all.push_back(static_cast<double>(at[i]));
        }
      });
    });
    return all;
  }

  void forget_bytes() { resources_.buffers[0].reset(); }
  // To an odd address.
  void move_bytes() {
    const std::string text(resources_.buffers[0]->text());
    resources_.buffers[0] = container::Bytes::from_string("x" + text).part(1, text.size());
  }

 private:
  json::Document document_;
  std::unique_ptr<Asset> asset_;
  Views views_;
  ResourceData resources_;
};

using Values = std::vector<double>;

constexpr const char* kVec3 =
    R"({"bufferView": 0, "componentType": 5126, "type": "VEC3", "count": 2})";

std::string view(std::size_t length, const std::string& more = {}) {
  return R"({"buffer": 0, "byteLength": )" + std::to_string(length) + more + "}";
}

TEST(AccessorData, PackedFloatsAreReadInPlace) {
  const AssetWithData asset(kVec3, view(24), floats({1, 2, 3, 4, 5, 6}));
  EXPECT_EQ(asset.values(), (Values{1, 2, 3, 4, 5, 6}));
}

TEST(AccessorData, StridesAndOffsetsAreHonoured) {
  const AssetWithData asset(
      R"({"bufferView": 0, "byteOffset": 4, "componentType": 5126, "type": "VEC2", "count": 2})",
      view(32, R"(, "byteOffset": 8, "byteStride": 16)"), floats({9, 9, 9, 1, 2, 9, 9, 3, 4, 9}));
  EXPECT_EQ(asset.values(), (Values{1, 2, 3, 4}));
}

TEST(AccessorData, EveryComponentType) {
  const auto read = [](int type, const std::string& bytes) {
    return AssetWithData(R"({"bufferView": 0, "type": "SCALAR", "count": 2, "componentType": )" +
                             std::to_string(type) + "}",
                         view(bytes.size()), bytes)
        .values();
  };
  EXPECT_EQ(read(5120, packed<std::int8_t>({-128, 127})), (Values{-128, 127}));
  EXPECT_EQ(read(5121, packed<std::uint8_t>({0, 255})), (Values{0, 255}));
  EXPECT_EQ(read(5122, packed<std::int16_t>({-32768, 32767})), (Values{-32768, 32767}));
  EXPECT_EQ(read(5123, packed<std::uint16_t>({0, 65535})), (Values{0, 65535}));
  EXPECT_EQ(read(5125, packed<std::uint32_t>({0, 4294967295U})), (Values{0, 4294967295.0}));
  EXPECT_EQ(read(5126, floats({-0.5F, 2.0F})), (Values{-0.5, 2}));
}

TEST(AccessorData, ColumnsOfSmallMatricesArePadded) {
  const AssetWithData mat2(
      R"({"bufferView": 0, "componentType": 5121, "type": "MAT2", "count": 2})", view(14),
      packed<std::uint8_t>({1, 2, 9, 9, 3, 4, 9, 9, 5, 6, 9, 9, 7, 8}));
  EXPECT_EQ(mat2.values(), (Values{1, 2, 3, 4, 5, 6, 7, 8}));
  const AssetWithData mat3(
      R"({"bufferView": 0, "componentType": 5123, "type": "MAT3", "count": 1})", view(22),
      packed<std::uint16_t>({1, 2, 3, 99, 4, 5, 6, 99, 7, 8, 9}));
  EXPECT_EQ(mat3.values(), (Values{1, 2, 3, 4, 5, 6, 7, 8, 9}));
  const AssetWithData bytes3(
      R"({"bufferView": 0, "componentType": 5121, "type": "MAT3", "count": 1})", view(11),
      packed<std::uint8_t>({1, 2, 3, 99, 4, 5, 6, 99, 7, 8, 9}));
  EXPECT_EQ(bytes3.values(), (Values{1, 2, 3, 4, 5, 6, 7, 8, 9}));
}

TEST(AccessorData, ManyBlocksKeepTheirOrder) {
  std::vector<std::uint16_t> numbers(50000);
  for (std::size_t i = 0; i < numbers.size(); ++i) numbers[i] = static_cast<std::uint16_t>(i);
  const std::string accessor =
      R"({"bufferView": 0, "componentType": 5123, "type": "SCALAR", "count": 50000})";
  const Values expected(numbers.begin(), numbers.end());
  EXPECT_EQ(AssetWithData(accessor, view(100000), packed(numbers)).values(), expected);
  // One byte further on nothing can be read in place.
  const AssetWithData shifted(accessor, view(100000, R"(, "byteOffset": 2)"),
                              "xx" + packed(numbers));
  EXPECT_EQ(shifted.values(), expected);
}

TEST(AccessorData, NothingBehindTheBytesIsRead) {
  const std::string bytes = floats({1, 2, 3, 4, 5, 6});
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    EXPECT_FALSE(AssetWithData(kVec3, view(24), bytes.substr(0, size)).open()) << size;
    EXPECT_FALSE(AssetWithData(kVec3, view(std::max<std::size_t>(size, 1)), bytes).open()) << size;
  }
  EXPECT_TRUE(AssetWithData(kVec3, view(24), bytes).open());
}

TEST(AccessorData, NumbersThatOverflowAreRefused) {
  const std::string bytes = floats({1, 2, 3, 4, 5, 6});
  const char* huge = "9007199254740992";
  const auto with = [&](const std::string& more, const std::string& view_more = {}) {
    return AssetWithData(R"({"bufferView": 0, "componentType": 5126, "type": "VEC3")" + more + "}",
                         view(24, view_more), bytes)
        .open()
        .has_value();
  };
  EXPECT_TRUE(with(R"(, "count": 2)"));
  EXPECT_FALSE(with(std::string(R"(, "count": )") + huge));
  EXPECT_FALSE(with(std::string(R"(, "count": 2, "byteOffset": )") + huge));
  EXPECT_FALSE(with(R"(, "count": 2)", std::string(R"(, "byteOffset": )") + huge));
  EXPECT_FALSE(with(R"(, "count": 1537228672809129302)"));
}

TEST(AccessorData, WhatIsNotOnItsBoundaryIsRefused) {
  const std::string bytes(40, '\0');
  EXPECT_FALSE(
      AssetWithData(
          R"({"bufferView": 0, "byteOffset": 2, "componentType": 5126, "type": "VEC3", "count": 1})",
          view(40), bytes)
          .open());
  EXPECT_FALSE(AssetWithData(kVec3, view(36, R"(, "byteOffset": 2)"), bytes).open());
  EXPECT_FALSE(AssetWithData(kVec3, view(36, R"(, "byteStride": 8)"), bytes).open());
}

TEST(AccessorData, MalformedMembersCountAsAbsentOnlyWhenAsked) {
  const AssetWithData asset(kVec3, view(24, R"(, "byteStride": 1000)"), floats({1, 2, 3, 4, 5, 6}));
  EXPECT_TRUE(asset.values(Malformed::unusable).empty());
  EXPECT_EQ(asset.values(Malformed::absent), (Values{1, 2, 3, 4, 5, 6}));
}

TEST(AccessorData, NoBytesNoData) {
  AssetWithData asset(kVec3, view(24), floats({1, 2, 3, 4, 5, 6}));
  asset.forget_bytes();
  EXPECT_FALSE(asset.open());
  EXPECT_FALSE(AssetWithData(R"({"componentType": 5126, "type": "VEC3", "count": 2})", view(24),
                             std::string(24, '\0'))
                   .open());
}

// Indices are view 1, values view 2; both are after four bytes of the base.
std::string sparse_views(const std::string& indices, const std::string& values) {
  return view(4) + ", " + view(indices.size(), R"(, "byteOffset": 4)") + ", " +
         view(values.size(), R"(, "byteOffset": )" + std::to_string(4 + indices.size()));
}

AssetWithData sparse(const std::string& base, std::vector<std::uint8_t> indices,
                     std::vector<std::uint8_t> values, const std::string& count) {
  const std::string index_bytes = packed(indices);
  const std::string value_bytes = packed(values);
  return {
      R"({"componentType": 5121, "type": "SCALAR", "count": 4)" + base +
          R"(, "sparse": {"count": )" + count +
          R"(, "indices": {"bufferView": 1, "componentType": 5121}, "values": {"bufferView": 2}}})",
      sparse_views(index_bytes, value_bytes), "\x01\x02\x03\x04" + index_bytes + value_bytes};
}
constexpr const char* kBase = R"(, "bufferView": 0)";

TEST(AccessorData, SparseElementsReplaceThoseOfTheBase) {
  EXPECT_EQ(sparse(kBase, {1, 3}, {70, 80}, "2").values(), (Values{1, 70, 3, 80}));
}

TEST(AccessorData, WithoutABaseTheOthersAreZero) {
  const AssetWithData asset = sparse("", {0, 2}, {70, 80}, "2");
  EXPECT_EQ(asset.values(), (Values{70, 0, 80, 0}));
  EXPECT_TRUE(asset.open()->implied());
  EXPECT_FALSE(sparse(kBase, {0}, {70}, "1").open()->implied());
}

TEST(AccessorData, ReplacingEndsWhereIndicesDoNotIncrease) {
  EXPECT_EQ(sparse(kBase, {2, 1, 3}, {70, 80, 90}, "3").values(), (Values{1, 2, 70, 4}));
  EXPECT_EQ(sparse(kBase, {1, 1, 3}, {70, 80, 90}, "3").values(), (Values{1, 70, 3, 4}));
  EXPECT_EQ(sparse(kBase, {1, 9}, {70, 80}, "2").values(), (Values{1, 70, 3, 4}));
}

TEST(AccessorData, SparseCountsThatLieAreRefused) {
  EXPECT_FALSE(sparse(kBase, {0, 1, 2, 3, 4}, {1, 2, 3, 4, 5}, "5").open());
  EXPECT_FALSE(sparse(kBase, {0}, {1}, "4000000000").open());
  EXPECT_FALSE(sparse(kBase, {0}, {1}, "9007199254740992").open());
  EXPECT_FALSE(sparse(kBase, {0}, {1, 2, 3}, "3").open());
  EXPECT_FALSE(sparse(kBase, {0, 1, 2}, {1}, "3").open());
}

TEST(AccessorData, ABrokenSparseObjectMakesTheDataUnusableOrIsDropped) {
  const AssetWithData asset = sparse(kBase, {0}, {9}, "\"one\"");
  EXPECT_TRUE(asset.values(Malformed::unusable).empty());
  EXPECT_EQ(asset.values(Malformed::absent), (Values{1, 2, 3, 4}));
}

TEST(AccessorData, ReadingForwardInAnyStepsGivesTheSame) {
  const AssetWithData asset = sparse(kBase, {1, 3}, {70, 80}, "2");
  const auto data = asset.open();
  ASSERT_TRUE(data);
  for (std::size_t step = 1; step <= 4; ++step) {
    std::vector<std::uint8_t> all(4);
    std::uint64_t next = 0;
    for (std::size_t at = 0; at < 4; at += step) {
      data->read(reinterpret_cast<std::byte*>(all.data() + at), at, std::min(step, 4 - at), next);
    }
    EXPECT_EQ(all, (std::vector<std::uint8_t>{1, 70, 3, 80})) << step;
  }
}

// With view 0 as the base, view 1 as the indices and view 2 as the values of the one element that
// is replaced.
AssetWithData with_sparse(const std::string& object, const std::string& views) {
  return {R"({"componentType": 5125, "type": "SCALAR", "count": 2, "bufferView": 0, "sparse": )" +
              object + "}",
          views, packed(std::vector<std::uint32_t>{5, 6, 1, 9})};
}

TEST(AccessorData, SparsePartsMustBeSound) {
  const std::string views =
      view(8) + ", " + view(4, R"(, "byteOffset": 8)") + ", " + view(4, R"(, "byteOffset": 12)");
  const std::string indices = R"("indices": {"bufferView": 1, "componentType": 5125})";
  const std::string values = R"("values": {"bufferView": 2})";
  const auto read = [&](const std::string& members, Malformed malformed = Malformed::unusable) {
    return with_sparse("{" + members + "}", views).values(malformed);
  };
  EXPECT_EQ(read(R"("count": 1, )" + indices + ", " + values), (Values{5, 9}));
  for (const std::string& broken :
       {R"("indices": {"bufferView": 1, "componentType": 5126}, )" + values,
        R"("indices": {"bufferView": 1, "componentType": 5125, "byteOffset": -4}, )" + values,
        R"("indices": {"componentType": 5125}, )" + values,
        indices + R"(, "values": {"bufferView": 2, "byteOffset": "4"})",
        indices + R"(, "values": {})", indices + R"(, "values": {"bufferView": 9})"}) {
    EXPECT_EQ(read(R"("count": 1, )" + broken), Values{}) << broken;
  }
  for (const std::string& incomplete :
       {indices + ", " + values, R"("count": 0, )" + indices + ", " + values,
        R"("count": 1, )" + indices, R"("count": 1, )" + values}) {
    EXPECT_EQ(read(incomplete), Values{}) << incomplete;
    EXPECT_EQ(read(incomplete, Malformed::absent), (Values{5, 6})) << incomplete;
  }
  EXPECT_EQ(read(R"("count": 1, )" + indices + ", " + values, Malformed::absent), (Values{5, 9}));
}

TEST(AccessorData, ViewsOfSparsePartsMustSayHowLongTheyAre) {
  const std::string object = R"({"count": 1, "values": {"bufferView": 2},
    "indices": {"bufferView": 1, "componentType": 5125}})";
  const auto read = [&](const std::string& index_view) {
    const std::string views = view(8) + ", " + index_view + ", " + view(4, R"(, "byteOffset": 12)");
    return with_sparse(object, views).values();
  };
  EXPECT_EQ(read(view(4, R"(, "byteOffset": 8)")), (Values{5, 9}));
  EXPECT_EQ(read(view(3, R"(, "byteOffset": 8)")), Values{});
  EXPECT_EQ(read(R"({"buffer": 0, "byteOffset": 8})"), Values{});
}

TEST(AccessorData, MalformedMembersOfTheAccessorAreRefused) {
  for (const char* const members :
       {R"("componentType": 5126, "type": "VEC3", "count": 2, "byteOffset": -4)",
        R"("componentType": 5126, "type": "VEC3", "count": 0)",
        R"("componentType": 5126, "type": "VEC5", "count": 2)",
        R"("componentType": 5124, "type": "VEC3", "count": 2)"}) {
    EXPECT_FALSE(AssetWithData(std::string(R"({"bufferView": 0, )") + members + "}", view(24),
                               floats({1, 2, 3, 4, 5, 6}))
                     .open())
        << members;
  }
}

TEST(AccessorData, BytesAtAnyAddressAreRead) {
  AssetWithData asset(kVec3, view(24), floats({1, 2, 3, 4, 5, 6}));
  asset.move_bytes();
  EXPECT_EQ(asset.values(), (Values{1, 2, 3, 4, 5, 6}));
}

TEST(AccessorData, PackedElementsNeedAKnownFormatAndTheirBytes) {
  const auto bytes = container::Bytes::from_string(std::string(16, '\0'));
  const Format floats{ElementType::vec4, ComponentType::float32, false};
  EXPECT_TRUE(AccessorData::packed(floats, 1, bytes, 0));
  EXPECT_FALSE(AccessorData::packed(floats, 0, bytes, 0));
  EXPECT_FALSE(AccessorData::packed(floats, 2, bytes, 0));
  EXPECT_FALSE(AccessorData::packed(floats, std::uint64_t{1} << 60U, bytes, 0));
  EXPECT_FALSE(
      AccessorData::packed({ElementType::vec2, ComponentType::float64, false}, 1, bytes, 0));
  EXPECT_FALSE(AccessorData::packed({ElementType::none, ComponentType::int8, false}, 1, bytes, 0));
}

TEST(Normalize, MapsIntegersToFractions) {
  EXPECT_EQ(normalize<std::int8_t>(127), 1.0);
  EXPECT_EQ(normalize<std::int8_t>(-127), -1.0);
  EXPECT_EQ(normalize<std::int8_t>(-128), -1.0);
  EXPECT_EQ(normalize<std::uint8_t>(255), 1.0);
  EXPECT_EQ(normalize<std::uint8_t>(51), 0.2);
  EXPECT_EQ(normalize<std::int16_t>(-32768), -1.0);
  EXPECT_EQ(normalize<std::uint16_t>(65535), 1.0);
}

}  // namespace
}  // namespace gltfx::model
