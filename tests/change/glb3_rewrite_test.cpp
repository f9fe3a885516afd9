// SPDX-License-Identifier: Apache-2.0
// GLBs of version 3 with other chunks, and GLBs in the other version.
#include <string>
#include <vector>

#include <gmock/gmock.h>

#include "change/rewrite.hpp"
#include "container/bytes.hpp"
#include "container/glb3_builder.hpp"

namespace gltfx::change {
namespace {

using container::Bytes;
using container::Container;
using container::join;
using container::kChunkBin;
using container::kChunkJson;
using container::test::Chunk3;
using container::test::glb3;
using testing::IsEmpty;

constexpr std::uint32_t kExtra = 0x41525458;

Container opened_3(const std::string& bytes) {
  return container::open_bytes(Bytes::from_string(bytes));
}

std::string rewritten_3(const std::string& bytes, std::string_view json,
                        const BinChanges& bins = {}) {
  const auto pieces = rewrite_glb(opened_3(bytes), json, bins);
  EXPECT_TRUE(pieces);
  return join(*pieces);
}

BinChange whole(std::string data) {
  BinChange change;
  change.whole = {Bytes::from_string(std::move(data))};
  return change;
}

const Chunk3 kChunkText{kChunkJson, R"({"a":12})"};
const Chunk3 kFirst{kChunkBin, "abcde"};
const Chunk3 kOddOne{kExtra, "xyz", 7};
const Chunk3 kSecond{kChunkJson, "[1]"};
const Chunk3 kLast{kChunkBin, "12345678"};

TEST(Glb3Rewrite, WithoutAChangeTheBytesAreTheSame) {
  for (const std::string& bytes :
       {glb3({kChunkText}), glb3({kChunkText, kFirst}),
        glb3({kOddOne, kChunkText, kFirst, kSecond, kLast}), glb3({kChunkText, kFirst}) + "\0\0\0",
        glb3({kChunkText, kFirst}) + "behind", glb3({kChunkText, kFirst, kLast}, {}, 'x'),
        glb3({{kChunkJson, "{}   "}, kFirst})}) {
    const Container container = opened_3(bytes);
    ASSERT_FALSE(find_glb_obstacle(container)) << *find_glb_obstacle(container);
    EXPECT_EQ(rewritten_3(bytes, *container.json), bytes);
  }
}

TEST(Glb3Rewrite, OnlyWhatChangesIsWrittenAnew) {
  const std::string bytes = glb3({kOddOne, kChunkText, kFirst, kSecond, kLast});
  EXPECT_EQ(rewritten_3(bytes, R"({"a":1234567})", {{2, whole("longer than before")}}),
            glb3({kOddOne,
                  {kChunkJson, R"({"a":1234567}   )"},
                  {kChunkBin, "longer than before"},
                  kSecond,
                  kLast}));
  EXPECT_EQ(rewritten_3(bytes, kChunkText.data, {{4, whole("1")}}),
            glb3({kOddOne, kChunkText, kFirst, kSecond, {kChunkBin, "1"}}));
}

TEST(Glb3Rewrite, AChunkIsDroppedAndOneIsMade) {
  BinChange gone;
  gone.drop = true;
  EXPECT_EQ(rewritten_3(glb3({kChunkText, kFirst, kOddOne, kLast}), kChunkText.data, {{1, gone}}),
            glb3({kChunkText, kOddOne, kLast}));
  EXPECT_EQ(rewritten_3(glb3({kChunkText}), kChunkText.data, {{kNewBin, whole("new")}}),
            glb3({kChunkText, {kChunkBin, "new"}}));
}

TEST(Glb3Rewrite, TheLengthOfTheTextKeepsItsAlignment) {
  EXPECT_EQ(rewritten_3(glb3({{kChunkJson, "{} "}}), "[12] "), glb3({{kChunkJson, "[12] "}}));
  EXPECT_EQ(rewritten_3(glb3({{kChunkJson, "{}  "}}), "[123]"), glb3({{kChunkJson, "[123]   "}}));
  EXPECT_EQ(rewritten_3(glb3({{kChunkJson, "{}          "}}), "[12345678]"),
            glb3({{kChunkJson, "[12345678]  "}}));
}

// White space up to a multiple of 8 must be blanks.
TEST(Glb3Rewrite, ALineBreakDoesNotBecomePadding) {
  for (const char* text : {"{}\n     ", "[1]\n", "[1, 2]\n", "{}\n\n\n\n\n\n"}) {
    std::string bytes = rewritten_3(glb3({{kChunkJson, "{}      "}}), text);
    const std::size_t size = bytes.size();
    for (int i = 0; i < 3; ++i) bytes = rewritten_3(bytes, *opened_3(bytes).json);
    EXPECT_EQ(bytes.size(), size) << text;
    const SharedText json = opened_3(bytes).json;
    EXPECT_TRUE(json->size() % 8 != 0 || json->size() - json->find('\n') >= 8) << text;
  }
}

TEST(Glb3Rewrite, PaddingAfterTheLastChunkStaysPadding) {
  const std::string old = glb3({kChunkText, kFirst}, 16 + 24 + 24) + std::string(3, '\0');
  const std::string now = rewritten_3(old, kChunkText.data, {{1, whole("12")}});
  EXPECT_EQ(now, glb3({kChunkText, {kChunkBin, "12"}}, 16 + 24 + 24) + std::string(6, '\0'));
}

TEST(Glb3Rewrite, SoundChunksHaveZerosBetweenThemAndNothingBehind) {
  const std::string bytes = glb3({kChunkText, kFirst, kLast}, 1000, 'x') + "behind";
  const auto pieces = rewrite_sound(opened_3(bytes), kChunkText.data);
  ASSERT_TRUE(pieces);
  EXPECT_EQ(join(*pieces), glb3({kChunkText, kFirst, kLast}));
}

std::string in_version(const std::string& bytes, std::uint32_t version, const BinChanges& bins) {
  const Container container = opened_3(bytes);
  const auto pieces = convert_glb(container, *container.json, bins, version);
  EXPECT_TRUE(pieces);
  return join(*pieces);
}

std::string version_2(std::vector<std::pair<std::uint32_t, std::string>> chunks) {
  std::string body;
  for (const auto& [type, data] : chunks) body += container::test::chunk(type, data);
  return container::test::glb(body);
}

TEST(Glb3Rewrite, VersionTwoHasTextBinAndOtherChunks) {
  EXPECT_EQ(in_version(glb3({{kExtra, "xyz"}, kChunkText, kFirst, kSecond, kLast, kOddOne}), 2,
                       {{kNewBin, whole("joined")}}),
            version_2({{kChunkJson, kChunkText.data},
                       {kChunkBin, std::string("joined\0\0", 8)},
                       {kExtra, std::string("xyz\0", 4)}}));
}

TEST(Glb3Rewrite, VersionThreeKeepsLengthsAndGoesBack) {
  const std::string old =
      version_2({{kChunkJson, "{\"a\":[] }\t  "}, {kChunkBin, "abcd"}, {kExtra, "12345678abcd"}});
  const std::string three = in_version(old, 3, {{1, whole("abcd")}});
  EXPECT_EQ(three,
            glb3({{kChunkJson, "{\"a\":[] }\t  "}, {kChunkBin, "abcd"}, {kExtra, "12345678abcd"}}));
  EXPECT_THAT(opened_3(three).errors, IsEmpty());
  EXPECT_EQ(in_version(three, 2, {{1, whole("abcd")}}), old);
}

TEST(Glb3Rewrite, ChunksThatStayAreNotCopied) {
  std::vector<Chunk3> chunks{kChunkText};
  for (int i = 0; i < 20'000; ++i) chunks.push_back({kExtra, ""});
  chunks.push_back(kLast);
  const std::string bytes = glb3(chunks);
  const auto pieces =
      rewrite_glb(opened_3(bytes), "{}", {{chunks.size() - 1, whole("0123456789")}});
  ASSERT_TRUE(pieces);
  EXPECT_LT(pieces->size(), 20U);
  chunks.front().data = "{}      ";
  chunks.back().data = "0123456789";
  EXPECT_EQ(join(*pieces), glb3(chunks));
}

TEST(Glb3Rewrite, WhereChunksAreUncertainNothingIsWritten) {
  const auto obstacle = [](const std::string& bytes) {
    return find_glb_obstacle(opened_3(bytes)).value_or("");
  };
  const std::string sound = glb3({kChunkText, kFirst});
  EXPECT_EQ(obstacle(sound), "");
  for (const std::size_t size : {3U, 17U, 25U, 40U, 50U}) {
    EXPECT_NE(obstacle(sound.substr(0, sound.size() - size)), "") << size;
  }
  constexpr std::uint64_t kTop = std::uint64_t{1} << 63U;
  EXPECT_NE(obstacle(glb3({kChunkText, {kChunkBin, "abcd", 0, kTop}})), "");
  EXPECT_NE(obstacle(glb3({kChunkText, {kChunkBin, "abcd", 0, kTop - 1}})), "");
  EXPECT_NE(obstacle(glb3({{kChunkJson, "{}", 1}, kFirst})), "");
  EXPECT_NE(obstacle(glb3({kFirst})), "");
  EXPECT_EQ(obstacle(glb3({kChunkText, kFirst}, kTop)), "");
}

}  // namespace
}  // namespace gltfx::change
