// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "selected.hpp"

namespace gltfx::test {
namespace {

Lines of_view(const std::string& view, Profile profile = Profile::standard) {
  return selected(asset_with(R"("buffers": [{"byteLength": 100}], "bufferViews": [)" + view + "]"),
                  {"BUFFER_VIEW_TOO_BIG_BYTE_STRIDE", "BUFFER_VIEW_INVALID_BYTE_STRIDE",
                   "BUFFER_VIEW_TOO_LONG", "VALUE_MULTIPLE_OF", "VALUE_NOT_IN_RANGE"},
                  profile);
}

TEST(BufferView, StrideMustFitTheView) {
  const Lines found{"BUFFER_VIEW_TOO_BIG_BYTE_STRIDE /bufferViews/0/byteStride"};
  EXPECT_EQ(of_view(R"({"buffer": 0, "byteLength": 8, "byteStride": 12})"), found);
  EXPECT_EQ(of_view(R"({"buffer": 0, "byteLength": 12, "byteStride": 12})"), Lines{});
}

TEST(BufferView, AStrideOfAViewWithoutALengthIsNotMeasured) {
  EXPECT_EQ(of_view(R"({"buffer": 0, "byteStride": 12})"), Lines{});
  EXPECT_EQ(of_view(R"({"buffer": 0, "byteLength": "8", "byteStride": 12})"), Lines{});
}

TEST(BufferView, AStrideOutOfRangeIsReportedOnce) {
  EXPECT_EQ(of_view(R"({"buffer": 0, "byteLength": 8, "byteStride": 256, "target": 34963})"),
            Lines{"VALUE_NOT_IN_RANGE /bufferViews/0/byteStride"});
}

TEST(BufferView, IndicesHaveNoStride) {
  EXPECT_EQ(of_view(R"({"buffer": 0, "byteLength": 8, "byteStride": 4, "target": 34963})"),
            Lines{"BUFFER_VIEW_INVALID_BYTE_STRIDE /bufferViews/0/byteStride"});
  EXPECT_EQ(of_view(R"({"buffer": 0, "byteLength": 8, "byteStride": 4, "target": 34962})"),
            Lines{});
}

TEST(BufferView, MustEndInsideItsBuffer) {
  const Lines at_length{"BUFFER_VIEW_TOO_LONG /bufferViews/0/byteLength"};
  const Lines at_offset{"BUFFER_VIEW_TOO_LONG /bufferViews/0/byteOffset"};
  EXPECT_EQ(of_view(R"({"buffer": 0, "byteLength": 100})"), Lines{});
  EXPECT_EQ(of_view(R"({"buffer": 0, "byteLength": 101})"), at_length);
  EXPECT_EQ(of_view(R"({"buffer": 0, "byteOffset": 99, "byteLength": 1})"), Lines{});
  EXPECT_EQ(of_view(R"({"buffer": 0, "byteOffset": 99, "byteLength": 2})"), at_length);
  EXPECT_EQ(of_view(R"({"buffer": 0, "byteOffset": 100, "byteLength": 1})"), at_offset);
  EXPECT_EQ(
      of_view(R"({"buffer": 0, "byteOffset": 9007199254740991, "byteLength": 9007199254740991})"),
      at_offset);
}

TEST(BufferView, WithoutASoundBufferNothingIsSaidOfItsEnd) {
  const auto places_of = [](const std::string& buffers) {
    return places(asset_with(R"("bufferViews": [{"buffer": 0, "byteLength": 9}])" + buffers),
                  "BUFFER_VIEW_TOO_LONG");
  };
  EXPECT_EQ(places_of(""), Lines{});
  EXPECT_EQ(places_of(R"(, "buffers": [{}])"), Lines{});
  EXPECT_EQ(places_of(R"(, "buffers": [{"byteLength": 0}])"), Lines{});
  EXPECT_EQ(places_of(R"(, "buffers": [{"byteLength": 8}])"), Lines{"/bufferViews/0/byteLength"});
}

TEST(BufferView, TheMessageNamesTheNumbers) {
  EXPECT_EQ(message(asset_with(R"("buffers": [{"byteLength": 10}],
    "bufferViews": [{"buffer": 0, "byteOffset": 4, "byteLength": 8}])"),
                    "BUFFER_VIEW_TOO_LONG"),
            "The buffer view takes 8 bytes at offset 4, but buffer 0 has only 10 bytes.");
}

}  // namespace
}  // namespace gltfx::test
