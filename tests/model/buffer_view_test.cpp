// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "asset_text.hpp"
#include "model/accessor.hpp"

namespace gltfx::model {
namespace {

TEST(BufferView, IsReadFromItsObject) {
  const test::AssetText text(R"({"buffers": [{}], "bufferViews": [
    {"buffer": 0, "byteOffset": 8, "byteLength": 12, "byteStride": 4, "target": 34963, "name": "x"},
    {"byteStride": 252, "target": 34962}]})");
  const auto views = read_buffer_views(text.asset);
  ASSERT_EQ(views.size(), 2U);
  EXPECT_EQ(views[0].buffer, 0U);
  EXPECT_EQ(views[0].byte_offset, 8U);
  EXPECT_EQ(views[0].byte_length, 12U);
  EXPECT_EQ(views[0].byte_stride, 4U);
  EXPECT_EQ(views[0].target, ViewTarget::indices);
  EXPECT_EQ(views[1].byte_stride, 252U);
  EXPECT_EQ(views[1].target, ViewTarget::vertices);
}

TEST(BufferView, MalformedMembersCountAsAbsent) {
  const test::AssetText text(R"({"buffers": [{}], "bufferViews": [7,
    {"buffer": "0", "byteOffset": -8, "byteLength": 0, "byteStride": 3, "target": 1},
    {"buffer": 1, "byteOffset": 0.5, "byteLength": "12", "byteStride": 253, "target": null}]})");
  const auto views = read_buffer_views(text.asset);
  ASSERT_EQ(views.size(), 3U);
  EXPECT_EQ(views[0].node, json::kNoNode);
  for (const BufferView& view : views) {
    EXPECT_FALSE(view.buffer);
    EXPECT_FALSE(view.byte_offset);
    EXPECT_FALSE(view.byte_length);
    EXPECT_FALSE(view.byte_stride);
    EXPECT_EQ(view.target, ViewTarget::none);
  }
}

}  // namespace
}  // namespace gltfx::model
