// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "selected.hpp"

namespace gltfx::test {
namespace {

const std::set<std::string, std::less<>> kCodes{
    "ACCESSOR_OFFSET_ALIGNMENT",      "ACCESSOR_TOTAL_OFFSET_ALIGNMENT",
    "ACCESSOR_SMALL_BYTESTRIDE",      "ACCESSOR_TOO_LONG",
    "BUFFER_VIEW_TARGET_OVERRIDE",    "ACCESSOR_SPARSE_COUNT_OUT_OF_RANGE",
    "BUFFER_VIEW_INVALID_BYTE_STRIDE"};

// View 0 has 100 bytes, so does view 1 with a stride of 8, view 2 begins at byte 2.
Lines of_accessor(const std::string& accessor, Profile profile = Profile::standard) {
  return selected(asset_with(R"("buffers": [{"byteLength": 400}], "bufferViews": [
      {"buffer": 0, "byteLength": 100}, {"buffer": 0, "byteLength": 100, "byteStride": 8},
      {"buffer": 0, "byteLength": 100, "byteOffset": 2}],
      "accessors": [)" + accessor +
                             "]"),
                  kCodes, profile);
}

TEST(AccessorLayout, OffsetIsAMultipleOfTheComponentSize) {
  const Lines found{"ACCESSOR_OFFSET_ALIGNMENT /accessors/0/byteOffset"};
  const auto at = [](const char* type, const char* offset) {
    return of_accessor(
        std::string(R"({"bufferView": 0, "type": "SCALAR", "count": 1, "componentType": )") + type +
        R"(, "byteOffset": )" + offset + "}");
  };
  EXPECT_EQ(at("5121", "3"), Lines{});
  EXPECT_EQ(at("5123", "2"), Lines{});
  EXPECT_EQ(at("5123", "3"), found);
  EXPECT_EQ(at("5126", "2"), found);
  EXPECT_EQ(at("5126", "4"), Lines{});
}

TEST(AccessorLayout, OffsetsOfAccessorAndViewAddUp) {
  const std::string odd =
      R"({"bufferView": 2, "type": "SCALAR", "count": 1, "componentType": 5126})";
  EXPECT_EQ(of_accessor(odd), Lines{"ACCESSOR_TOTAL_OFFSET_ALIGNMENT /accessors/0"});
  EXPECT_EQ(
      of_accessor(R"({"bufferView": 2, "type": "SCALAR", "count": 1, "componentType": 5123})"),
      Lines{});
}

TEST(AccessorLayout, AnOffsetAtErrorIsSaidOnceButForTheKhronosProfile) {
  const std::string both =
      R"({"bufferView": 2, "type": "SCALAR", "count": 1, "componentType": 5126, "byteOffset": 1})";
  EXPECT_EQ(of_accessor(both), Lines{"ACCESSOR_OFFSET_ALIGNMENT /accessors/0/byteOffset"});
  EXPECT_EQ(of_accessor(both, Profile::khronos),
            (Lines{"ACCESSOR_OFFSET_ALIGNMENT /accessors/0/byteOffset",
                   "ACCESSOR_TOTAL_OFFSET_ALIGNMENT /accessors/0"}));
}

TEST(AccessorLayout, ElementsEndInsideTheirView) {
  const auto with = [](const char* members) {
    return of_accessor(std::string(R"({"componentType": 5126, )") + members + "}");
  };
  const Lines found{"ACCESSOR_TOO_LONG /accessors/0"};
  EXPECT_EQ(with(R"("bufferView": 0, "type": "SCALAR", "count": 25)"), Lines{});
  EXPECT_EQ(with(R"("bufferView": 0, "type": "SCALAR", "count": 26)"), found);
  EXPECT_EQ(with(R"("bufferView": 0, "type": "VEC3", "count": 8, "byteOffset": 4)"), Lines{});
  EXPECT_EQ(with(R"("bufferView": 0, "type": "VEC3", "count": 8, "byteOffset": 8)"), found);
  EXPECT_EQ(with(R"("bufferView": 1, "type": "SCALAR", "count": 13)"), Lines{})
      << "the last element needs no stride after it";
  EXPECT_EQ(with(R"("bufferView": 1, "type": "SCALAR", "count": 14)"), found);
  EXPECT_EQ(with(R"("bufferView": 0, "type": "SCALAR", "count": 1, "byteOffset": 100)"), found);
  EXPECT_EQ(with(R"("bufferView": 0, "type": "SCALAR", "count": 1, "byteOffset": 104)"),
            Lines{"ACCESSOR_TOO_LONG /accessors/0/byteOffset"});
  EXPECT_EQ(with(R"("bufferView": 0, "type": "MAT4", "count": 9007199254740991)"), found);
}

TEST(AccessorLayout, ColumnsOfMatricesArePadded) {
  const auto of = [](const char* view_length, const char* component, const char* type) {
    return places(
        asset_with(
            R"("buffers": [{"byteLength": 40}], "bufferViews": [{"buffer": 0, "byteLength": )" +
            std::string(view_length) + R"(}], "accessors": [{"bufferView": 0, "count": 1,
        "componentType": )" +
            component + R"(, "type": ")" + type + R"("}])"),
        "ACCESSOR_TOO_LONG");
  };
  EXPECT_EQ(of("6", "5121", "MAT2"), Lines{});
  EXPECT_EQ(of("5", "5121", "MAT2"), Lines{"/accessors/0"});
  EXPECT_EQ(of("11", "5121", "MAT3"), Lines{});
  EXPECT_EQ(of("10", "5121", "MAT3"), Lines{"/accessors/0"});
  EXPECT_EQ(of("22", "5122", "MAT3"), Lines{});
  EXPECT_EQ(of("21", "5122", "MAT3"), Lines{"/accessors/0"});
}

TEST(AccessorLayout, StrideIsAtLeastOneElement) {
  const Lines found{"ACCESSOR_SMALL_BYTESTRIDE /accessors/0"};
  EXPECT_EQ(of_accessor(R"({"bufferView": 1, "type": "VEC3", "count": 3, "componentType": 5126})"),
            found);
  EXPECT_EQ(of_accessor(R"({"bufferView": 1, "type": "VEC2", "count": 3, "componentType": 5126})"),
            Lines{});
}

TEST(AccessorLayout, WhatIsMissingOrWrongElsewhereIsNotMeasured) {
  EXPECT_EQ(
      of_accessor(
          R"({"bufferView": 0, "type": "VEC3", "count": 0, "componentType": 5126, "byteOffset": 1})"),
      Lines{});
  EXPECT_EQ(of_accessor(R"({"bufferView": 9, "type": "VEC3", "count": 99, "componentType": 5126})"),
            Lines{});
  EXPECT_EQ(of_accessor(R"({"bufferView": 0, "type": "VEC9", "count": 99, "componentType": 5126})"),
            Lines{});
  EXPECT_EQ(of_accessor(R"({"type": "VEC3", "count": 99, "componentType": 5126})"), Lines{});
}

TEST(AccessorLayout, AnOffsetThatIsNoneIsNotMeasured) {
  for (const char* const offset : {"-4", "0.5", "\"4\""}) {
    for (const Profile profile : {Profile::standard, Profile::khronos}) {
      EXPECT_EQ(of_accessor(std::string(R"({"bufferView": 0, "type": "SCALAR", "count": 99,
        "componentType": 5126, "byteOffset": )") +
                                offset + "}",
                            profile),
                Lines{})
          << offset;
    }
  }
}

TEST(AccessorLayout, AStrideTooSmallIsMeasuredWithInTheKhronosProfileOnly) {
  const std::string accessor =
      R"({"bufferView": 1, "type": "VEC3", "count": 99, "componentType": 5126})";
  EXPECT_EQ(of_accessor(accessor), Lines{"ACCESSOR_SMALL_BYTESTRIDE /accessors/0"});
  EXPECT_EQ(of_accessor(accessor, Profile::khronos),
            (Lines{"ACCESSOR_SMALL_BYTESTRIDE /accessors/0", "ACCESSOR_TOO_LONG /accessors/0"}));
}

TEST(AccessorLayout, AViewWithoutALengthHasNothingInTheKhronosProfile) {
  const std::string asset = asset_with(R"("buffers": [{"byteLength": 9}],
    "bufferViews": [{"buffer": 0}],
    "accessors": [{"bufferView": 0, "type": "SCALAR", "count": 1, "componentType": 5121}])");
  EXPECT_EQ(selected(asset, kCodes), Lines{});
  EXPECT_EQ(selected(asset, kCodes, Profile::khronos),
            Lines{"ACCESSOR_TOO_LONG /accessors/0/byteOffset"});
}

Lines of_sparse(const std::string& sparse, Profile profile = Profile::standard) {
  return of_accessor(
      R"({"type": "VEC3", "count": 3, "componentType": 5126, "sparse": )" + sparse + "}", profile);
}

TEST(SparseAccessor, ReplacesAtMostAllElements) {
  const auto with = [](const char* count) {
    return of_sparse(std::string(R"({"indices": {"bufferView": 0, "componentType": 5121},
      "values": {"bufferView": 0}, "count": )") +
                     count + "}");
  };
  EXPECT_EQ(with("3"), Lines{});
  EXPECT_EQ(with("4"), Lines{"ACCESSOR_SPARSE_COUNT_OUT_OF_RANGE /accessors/0/sparse/count"});
}

TEST(SparseAccessor, PartsLieSideBySideOnTheirBoundaries) {
  EXPECT_EQ(of_sparse(R"({"count": 1, "indices": {"bufferView": 1, "componentType": 5121},
              "values": {"bufferView": 0}})"),
            Lines{"BUFFER_VIEW_INVALID_BYTE_STRIDE /accessors/0/sparse/indices/bufferView"});
  EXPECT_EQ(
      of_sparse(
          R"({"count": 1, "indices": {"bufferView": 0, "componentType": 5123, "byteOffset": 1},
              "values": {"bufferView": 0, "byteOffset": 90}})"),
      (Lines{"ACCESSOR_OFFSET_ALIGNMENT /accessors/0/sparse/indices/byteOffset",
             "ACCESSOR_OFFSET_ALIGNMENT /accessors/0/sparse/values/byteOffset",
             "ACCESSOR_TOO_LONG /accessors/0/sparse/values"}));
  EXPECT_EQ(
      of_sparse(
          R"({"count": 1, "indices": {"bufferView": 0, "componentType": 5121, "byteOffset": 101},
              "values": {"bufferView": 2}})"),
      (Lines{"ACCESSOR_TOO_LONG /accessors/0/sparse/indices/byteOffset",
             "ACCESSOR_TOTAL_OFFSET_ALIGNMENT /accessors/0/sparse/values"}));
}

TEST(SparseAccessor, PartsOfAnUnknownFormatAreNotMeasured) {
  const std::string sparse = R"("count": 3, "type": "SCALAR", "sparse": {"count": 1,
    "indices": {"bufferView": 0, "componentType": 7, "byteOffset": 1},
    "values": {"bufferView": 0, "byteOffset": 1}}})";
  EXPECT_EQ(of_accessor(R"({"componentType": 7, )" + sparse, Profile::khronos), Lines{});
  EXPECT_EQ(of_accessor(R"({"componentType": 5123, )" + sparse, Profile::khronos),
            (Lines{"ACCESSOR_OFFSET_ALIGNMENT /accessors/0/sparse/values/byteOffset",
                   "ACCESSOR_TOTAL_OFFSET_ALIGNMENT /accessors/0/sparse/values"}));
}

TEST(SparseAccessor, AnIncompleteOneIsLeftAlone) {
  EXPECT_EQ(of_sparse(R"({"count": 9, "indices": {"bufferView": 1, "componentType": 5126},
              "values": {"bufferView": 1}})"),
            Lines{});
}

}  // namespace
}  // namespace gltfx::test
