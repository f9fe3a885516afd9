// SPDX-License-Identifier: Apache-2.0
// The padding of the chunks of a GLB to a multiple of four bytes: spaces after JSON, zeros after
// the buffer.
#include <string>

#include <gtest/gtest.h>

#include "container/glb3_builder.hpp"
#include "container/glb_builder.hpp"
#include "rules/selected.hpp"

namespace gltfx::test {
namespace {

using container::test::bin_chunk;
using container::test::chunk;
using container::test::glb;

const std::string kText = R"({"asset": {"version": "2.0"}})";
const std::string kPaddedAt = "GLB_JSON_PADDING @" + std::to_string(20 + kText.size());

Lines about_padding(const std::string& glb, Profile profile = Profile::standard) {
  return selected(glb, {"GLB_JSON_PADDING", "GLB_BIN_PADDING"}, profile);
}

// Appends those bytes as padding, regardless of their number.
Lines behind_json(const std::string& bytes, Profile profile = Profile::standard) {
  return about_padding(glb(chunk(container::kChunkJson, kText + bytes)), profile);
}

TEST(JsonPadding, IsMadeOfSpaces) {
  ASSERT_EQ(kText.size() % 4, 1U);
  EXPECT_EQ(behind_json("   "), Lines{});
  EXPECT_EQ(behind_json("\n\n\n"), Lines{kPaddedAt});
  EXPECT_EQ(behind_json("\t  "), Lines{kPaddedAt});
  EXPECT_EQ(behind_json("  \r"), Lines{"GLB_JSON_PADDING @" + std::to_string(22 + kText.size())});
  EXPECT_EQ(behind_json("\n\n\n", Profile::khronos), Lines{});
}

TEST(JsonPadding, EndsWhereTheTextHasItsOwnWhiteSpace) {
  EXPECT_EQ(behind_json("\n\n\n    "), Lines{});
  EXPECT_EQ(about_padding(kText + "\n\n\n"), Lines{}) << "a text without chunks";
  EXPECT_EQ(behind_json("\n"), Lines{}) << "the length of the chunk is what is wrong";
}

TEST(JsonPadding, IsNotNeededInVersion3) {
  const std::string text = kText + std::string(7 - kText.size() % 8, ' ') + "\n";
  ASSERT_EQ(text.size() % 8, 0U);
  EXPECT_EQ(about_padding(container::test::glb3({{container::kChunkJson, text}})), Lines{});
}

Lines behind_buffer(std::size_t length, const std::string& bin,
                    Profile profile = Profile::standard) {
  std::string text = asset_with(R"("buffers": [{"byteLength": )" + std::to_string(length) + "}]");
  text.resize((text.size() + 3) / 4 * 4, ' ');
  return about_padding(glb(chunk(container::kChunkJson, text) + bin_chunk(bin)), profile);
}

TEST(BinPadding, IsMadeOfZeros) {
  const std::string zeros(3, '\0');
  const Lines found{"GLB_BIN_PADDING /buffers/0"};
  EXPECT_EQ(behind_buffer(4, "abcd"), Lines{});
  EXPECT_EQ(behind_buffer(5, "abcde" + zeros), Lines{});
  EXPECT_EQ(behind_buffer(5, "abcde   "), found);
  EXPECT_EQ(behind_buffer(7, "abcdefgh"), found);
  EXPECT_EQ(behind_buffer(7, "abcdefgh", Profile::khronos), Lines{});
  EXPECT_EQ(behind_buffer(3, "abc" + zeros + "xx"), Lines{}) << "more than padding";
}

}  // namespace
}  // namespace gltfx::test
