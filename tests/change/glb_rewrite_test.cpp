// SPDX-License-Identifier: Apache-2.0
#include <string>

#include <gtest/gtest.h>
#include <sys/mman.h>

#include "change/rewrite.hpp"
#include "container/bytes.hpp"
#include "container/glb_builder.hpp"

namespace gltfx::change {
namespace {

using container::Bytes;
using container::Container;
using container::join;
using container::test::chunk;
using container::test::glb;

constexpr std::uint32_t kOther = 0x12345678;

std::string rewritten(const std::string& bytes, const std::string& json) {
  const Container opened = container::open_bytes(Bytes::from_string(bytes));
  auto result = rewrite_glb(opened, json);
  EXPECT_TRUE(result);
  return join(*result);
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

TEST(GlbRewrite, TheResultIsReadWithoutErrors) {
  const std::string bytes = rewritten(file("{}", chunk(container::kChunkBin, "abcd")), "[]");
  const Container opened = container::open_bytes(Bytes::from_string(bytes));
  EXPECT_TRUE(opened.errors.empty());
  EXPECT_TRUE(opened.late_errors.empty());
  EXPECT_EQ(*opened.json, "[]  ");
}

std::string with_length(std::string bytes, std::size_t length) {
  for (unsigned i = 0; i < 4; ++i) bytes[8 + i] = static_cast<char>((length >> (8U * i)) & 0xFFU);
  return bytes;
}

TEST(GlbRewrite, WrongLengthsAreMended) {
  const std::string bin = chunk(container::kChunkBin, "abcd");
  const std::string sound = file("{}", bin);
  for (const std::size_t length : {std::size_t{5}, std::size_t{20}, sound.size() + 100}) {
    EXPECT_EQ(rewritten(with_length(sound, length), "[1]"), file("[1]", bin)) << length;
  }
}

// Up to three characters of white space are padding, which must be blanks.
TEST(GlbRewrite, ALineBreakAtTheEndDoesNotBecomePadding) {
  for (const char* text : {"[12]\n   ", "[1]\n    ", "[]\n     ", "{}\n         "}) {
    std::string again = rewritten(file("{}", ""), text);
    for (int i = 0; i < 3; ++i) {
      const Container opened = container::open_bytes(Bytes::from_string(again));
      again = rewritten(again, std::string(*opened.json));
    }
    const Container opened = container::open_bytes(Bytes::from_string(again));
    EXPECT_GE(opened.json->size() - opened.json->find('\n'), 4U) << text;
    EXPECT_LE(opened.json->size(), std::string_view(text).size() + 3) << text;
  }
}

TEST(GlbRewrite, WhatLiesBehindTheLastChunkStaysUncounted) {
  const std::string sound = file("{}", chunk(container::kChunkBin, "abcd"));
  const std::string fresh = file("[12345]", chunk(container::kChunkBin, "abcd"));
  EXPECT_EQ(rewritten(sound + "xyz", "[12345]"), fresh + "xyz");
}

TEST(GlbRewrite, ChunksThatAreNotKnownNotInOrderOrNotAlignedStay) {
  const std::string rest = chunk(kOther, "1234") + chunk(container::kChunkBin, "ab") +
                           chunk(container::kChunkBin, "") + chunk(container::kChunkJson, "[3]");
  EXPECT_EQ(rewritten(glb(chunk(container::kChunkJson, "[1,2]") + rest), "[0]"), file("[0]", rest));
}

TEST(GlbRewrite, PartsOfTheBinChunkAreTakenOut) {
  const std::string old = file("{}", chunk(container::kChunkBin, "abcdefghijkl"));
  const Container opened = container::open_bytes(Bytes::from_string(old));
  BinChange change;
  change.cut = {{0, 4}, {8, 12}};
  EXPECT_EQ(join(*rewrite_glb(opened, "[]", {{1, change}})),
            file("[]", chunk(container::kChunkBin, "efgh")));
  change.more = "xyzw";
  EXPECT_EQ(join(*rewrite_glb(opened, "[]", {{1, change}})),
            file("[]", chunk(container::kChunkBin, "efghxyzw")));
}

// Reserves addresses only: only the end of the text is read.
TEST(GlbRewrite, BeyondFourGibibytesThereIsNoGlb) {
  constexpr std::size_t kSize = std::size_t{1} << 32U;
  void* const memory =
      ::mmap(nullptr, kSize, PROT_READ, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
  ASSERT_NE(memory, MAP_FAILED);
  const Container opened = container::open_bytes(Bytes::from_string(file("{}", "")));
  const auto result = rewrite_glb(opened, {static_cast<const char*>(memory), kSize});
  ::munmap(memory, kSize);
  ASSERT_FALSE(result);
  EXPECT_NE(result.error().message.find("4 GiB"), std::string::npos);
}

TEST(GlbRewrite, WhereChunksCannotBeToldApartNothingIsWritten) {
  const std::string sound = file("{}", chunk(container::kChunkBin, "abcd"));
  const auto obstacle = [](const std::string& bytes) {
    return find_glb_obstacle(container::open_bytes(Bytes::from_string(bytes))).value_or("");
  };
  EXPECT_EQ(obstacle(sound), "");
  EXPECT_NE(obstacle(sound.substr(0, sound.size() - 1)), "");
  EXPECT_NE(obstacle(sound.substr(0, sound.size() - 6)), "");
  EXPECT_NE(obstacle(glb(chunk(kOther, "1234") + chunk(container::kChunkJson, "{}  "))), "");
}

}  // namespace
}  // namespace gltfx::change
