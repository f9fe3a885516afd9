// SPDX-License-Identifier: Apache-2.0
#include "upgrade/glb_rewrite.hpp"

#include <string>

#include <gtest/gtest.h>

#include "container/glb_builder.hpp"

namespace gltfx::upgrade {
namespace {

using container::Bytes;
using container::Container;
using container::test::chunk;
using container::test::glb;

constexpr std::uint32_t kOther = 0x12345678;

std::string rewritten(const std::string& bytes, const std::string& json) {
  const Container opened = container::open_bytes(Bytes::from_string(bytes));
  auto result = rewrite_glb(opened, json);
  EXPECT_TRUE(result);
  return *result;
}

std::string file(const std::string& json, const std::string& rest) {
  std::string padded = json;
  padded.resize((json.size() + 3) / 4 * 4, ' ');
  return glb(chunk(container::kChunkJson, padded) + rest);
}

TEST(GlbRewrite, LengthsAndPaddingFollowAndOtherChunksStay) {
  const std::string rest =
      chunk(container::kChunkBin, std::string("\0\1\2\377", 4)) + chunk(kOther, "12345678");
  const std::string old = file(R"({"a":1})", rest);
  for (std::size_t length = 0; length < 9; ++length) {
    const std::string json = std::string(R"({"b":")").append(length, 'x').append(R"("})");
    EXPECT_EQ(rewritten(old, json), file(json, rest)) << length;
  }
}

TEST(GlbRewrite, OldPaddingIsNotKept) {
  const std::string old = file("{}", "");
  const Container opened = container::open_bytes(Bytes::from_string(old));
  ASSERT_EQ(*opened.json, "{}  ");
  EXPECT_EQ(rewritten(old, std::string(*opened.json)), old);
  EXPECT_EQ(rewritten(old, R"({"a": 12}   )"), file(R"({"a": 12})", ""));
}

TEST(GlbRewrite, TheResultIsReadWithoutFaults) {
  const std::string bytes = rewritten(file("{}", chunk(container::kChunkBin, "abcd")), "[]");
  const Container opened = container::open_bytes(Bytes::from_string(bytes));
  EXPECT_TRUE(opened.faults.empty());
  EXPECT_TRUE(opened.late_faults.empty());
  EXPECT_EQ(*opened.json, "[]  ");
}

}  // namespace
}  // namespace gltfx::upgrade
