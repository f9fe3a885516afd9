// SPDX-License-Identifier: Apache-2.0
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "container/glb_builder.hpp"

namespace gltfx::container::test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr std::uint32_t kJsonEnd = 12 + 8 + 28;  // of header and the usual JSON chunk

std::vector<std::string> codes(const std::vector<ContainerError>& errors) {
  std::vector<std::string> out;
  for (const ContainerError& error : errors) {
    out.push_back(std::string(code_name(error.code)) + "@" + std::to_string(error.offset));
  }
  return out;
}

/// Early and late errors with a bar between them.
std::vector<std::string> all_codes(const Container& container) {
  std::vector<std::string> out = codes(container.errors);
  out.emplace_back("|");
  for (std::string& code : codes(container.late_errors)) out.push_back(std::move(code));
  return out;
}

TEST(Glb, AWellFormedFileHasNoErrors) {
  const Container container = open_glb(glb(json_chunk() + bin_chunk()));
  EXPECT_EQ(container.format, Format::glb);
  EXPECT_THAT(all_codes(container), ElementsAre("|"));
  EXPECT_EQ(container.glb_version, 2U);
  EXPECT_EQ(*container.json, kJson);
  EXPECT_EQ(container.json_offset, 20U);
  ASSERT_TRUE(container.bin);
  EXPECT_EQ(container.bin->header_offset, kJsonEnd);
  EXPECT_EQ(container.bytes.part(container.bin->offset, container.bin->length).text(), "abcd");
  EXPECT_EQ(container.chunks.size(), 2U);
  EXPECT_FALSE(container.cut_short);
  EXPECT_FALSE(container.ends_in_empty_chunk);
}

TEST(Glb, BinMayBeLeftOut) {
  const Container container = open_glb(glb(json_chunk()));
  EXPECT_THAT(all_codes(container), ElementsAre("|"));
  EXPECT_FALSE(container.bin);
}

TEST(Glb, AWrongMagicIsTheOnlyError) {
  GlbHeader header;
  header.magic = 0x00444342;
  header.version = 9;
  const Container container = open_glb(glb(json_chunk(), header));
  EXPECT_THAT(all_codes(container), ElementsAre("GLB_INVALID_MAGIC@0", "|"));
  EXPECT_THAT(container.errors[0].message, HasSubstr("0x00444342 ('BCD')"));
  EXPECT_FALSE(container.glb_version);
  EXPECT_EQ(container.json, nullptr);
}

TEST(Glb, AnotherVersionIsTheOnlyErrorAndIsKept) {
  for (const std::uint32_t version : {0U, 1U, 4U}) {
    GlbHeader header;
    header.version = version;
    header.length = 0;
    const Container container = open_glb(glb(json_chunk(), header));
    EXPECT_THAT(all_codes(container), ElementsAre("GLB_INVALID_VERSION@4", "|"));
    EXPECT_EQ(container.glb_version, version);
    EXPECT_EQ(container.json, nullptr);
  }
}

TEST(Glb, TheHelpForVersionOneNamesGltfOne) {
  GlbHeader header;
  header.version = 1;
  EXPECT_THAT(open_glb(glb("", header)).errors[0].help, HasSubstr("glTF 1.0"));
}

TEST(Glb, ADeclaredLengthOfTwelveOrLessIsTooSmall) {
  EXPECT_THAT(all_codes(open_glb(glb("", {12}))), ElementsAre("GLB_LENGTH_TOO_SMALL@8", "|"));
  EXPECT_THAT(all_codes(open_glb(glb("", {13}))), ElementsAre("|", "GLB_LENGTH_MISMATCH@12"));
  EXPECT_THAT(all_codes(open_glb(glb("", {11}))),
              ElementsAre("GLB_LENGTH_TOO_SMALL@8", "|", "GLB_LENGTH_MISMATCH@12"));
}

TEST(Glb, AfterALengthTooSmallReadingGoesOn) {
  const Container container = open_glb(glb(json_chunk(), {0}));
  EXPECT_THAT(all_codes(container), ElementsAre("GLB_LENGTH_TOO_SMALL@8", "GLB_CHUNK_TOO_BIG@12",
                                                "|", "GLB_LENGTH_MISMATCH@48"));
  EXPECT_EQ(*container.json, kJson);
}

TEST(Glb, ALengthThatDiffersIsReportedAtTheEnd) {
  const Container container = open_glb(glb(json_chunk() + bin_chunk(), {120}));
  EXPECT_THAT(all_codes(container), ElementsAre("|", "GLB_LENGTH_MISMATCH@60"));
  EXPECT_EQ(container.late_errors[0].message,
            "The file length in the header is 120 bytes, but the file has 60.");
  EXPECT_FALSE(container.cut_short);
}

TEST(Glb, BytesBehindTheDeclaredLengthAreExtraAndIgnored) {
  const Container container = open_glb(glb(json_chunk() + bin_chunk(), {kJsonEnd}));
  EXPECT_THAT(all_codes(container), ElementsAre("GLB_EXTRA_DATA@48", "|"));
  EXPECT_THAT(container.errors[0].message, HasSubstr("12 more"));
  EXPECT_FALSE(container.bin);
}

TEST(Glb, AChunkMustBeAMultipleOfFour) {
  for (const std::size_t size : {1U, 2U, 3U, 5U}) {
    const Container container = open_glb(glb(json_chunk() + bin_chunk(std::string(size, 'x'))));
    EXPECT_THAT(all_codes(container), ElementsAre("GLB_CHUNK_LENGTH_UNALIGNED@48", "|"));
    EXPECT_THAT(container.errors[0].help,
                HasSubstr("with " + std::to_string(4 - size % 4) + " byte"));
  }
}

TEST(Glb, AChunkMustEndInsideTheDeclaredLength) {
  EXPECT_THAT(all_codes(open_glb(glb(json_chunk() + bin_chunk(), {60}))), ElementsAre("|"));
  const Container container = open_glb(glb(json_chunk() + bin_chunk(), {59}));
  EXPECT_THAT(all_codes(container),
              ElementsAre("GLB_CHUNK_TOO_BIG@48", "|", "GLB_LENGTH_MISMATCH@60"));
  EXPECT_THAT(container.errors[0].message,
              HasSubstr("ends at byte 60, but the file length in the header is 59"));
  EXPECT_EQ(container.bin->length, 4U);
}

TEST(Glb, TheFirstChunkMustBeJson) {
  const Container container = open_glb(glb(bin_chunk() + json_chunk()));
  EXPECT_THAT(all_codes(container), ElementsAre("GLB_UNEXPECTED_FIRST_CHUNK@12", "|"));
  EXPECT_THAT(container.errors[0].message, HasSubstr("0x004e4942 ('BIN')"));
  EXPECT_EQ(*container.json, kJson);
  EXPECT_EQ(container.bin->header_offset, 12U);
}

TEST(Glb, TheBinChunkMustBeTheSecond) {
  const Container container =
      open_glb(glb(json_chunk() + chunk(kChunkOther, "abcd") + bin_chunk()));
  EXPECT_THAT(all_codes(container),
              ElementsAre("GLB_UNKNOWN_CHUNK_TYPE@48", "GLB_UNEXPECTED_BIN_CHUNK@60", "|"));
  EXPECT_THAT(container.errors[1].message, HasSubstr("chunk 3"));
  EXPECT_EQ(container.bin->header_offset, 60U);
}

TEST(Glb, AnEmptyJsonChunkIsAnErrorAndNoText) {
  const Container container = open_glb(glb(chunk(kChunkJson, "") + bin_chunk()));
  EXPECT_THAT(all_codes(container), ElementsAre("GLB_EMPTY_CHUNK@12", "|"));
  EXPECT_EQ(container.json, nullptr);
}

TEST(Glb, AnEmptyBinChunkShouldBeLeftOut) {
  const Container container = open_glb(glb(json_chunk() + bin_chunk("")));
  EXPECT_THAT(all_codes(container), ElementsAre("GLB_EMPTY_BIN_CHUNK@48", "|"));
  EXPECT_TRUE(container.ends_in_empty_chunk);
  EXPECT_EQ(container.bin->length, 0U);
}

TEST(Glb, OfTwoChunksOfOneTypeTheFirstCounts) {
  const Container container = open_glb(
      glb(json_chunk() + bin_chunk("1111") + bin_chunk("2222") + chunk(kChunkJson, "{}  ")));
  EXPECT_THAT(all_codes(container),
              ElementsAre("GLB_DUPLICATE_CHUNK@60", "GLB_DUPLICATE_CHUNK@72", "|"));
  EXPECT_EQ(*container.json, kJson);
  EXPECT_EQ(container.bytes.part(container.bin->offset, 4).text(), "1111");
}

TEST(Glb, ASecondJsonDoesNotReplaceAnEmptyFirst) {
  const Container container = open_glb(glb(chunk(kChunkJson, "") + json_chunk()));
  EXPECT_THAT(all_codes(container),
              ElementsAre("GLB_EMPTY_CHUNK@12", "GLB_DUPLICATE_CHUNK@20", "|"));
  EXPECT_EQ(container.json, nullptr);
}

TEST(Glb, UnknownChunksAreSkipped) {
  const Container container =
      open_glb(glb(json_chunk() + bin_chunk() + chunk(0xFF010203, "12345678")));
  EXPECT_THAT(all_codes(container), ElementsAre("GLB_UNKNOWN_CHUNK_TYPE@60", "|"));
  EXPECT_THAT(container.errors[0].message, HasSubstr("0xff010203 is"));
  EXPECT_EQ(container.chunks.back().length, 8U);
}

TEST(Glb, LettersOfATypeAreShownWhereTheyArePlain) {
  const auto said = [](std::uint32_t type) {
    return open_glb(glb(json_chunk() + bin_chunk() + chunk(type, ""))).errors.at(0).message;
  };
  EXPECT_THAT(said(0x00434241), HasSubstr("0x00434241 ('ABC') is"));
  EXPECT_THAT(said(0x00000000), HasSubstr("0x00000000 is"));
  EXPECT_THAT(said(0x41274241), HasSubstr("0x41274241 is"));
  EXPECT_THAT(said(0x417F4241), HasSubstr("0x417f4241 is"));
  EXPECT_THAT(said(0x411B4241), HasSubstr("0x411b4241 is"));
}

TEST(Glb, ErrorsOfOneChunkComeInTheirOrder) {
  const Container container = open_glb(glb(chunk(kChunkBin, "abcde", 7), {20}));
  EXPECT_THAT(
      all_codes(container),
      ElementsAre("GLB_CHUNK_LENGTH_UNALIGNED@12", "GLB_CHUNK_TOO_BIG@12",
                  "GLB_UNEXPECTED_FIRST_CHUNK@12", "|", "GLB_UNEXPECTED_END_OF_CHUNK_DATA@25"));
}

TEST(Glb, AFileThatEndsInAChunkIsCutShort) {
  const Container container = open_glb(glb(json_chunk() + chunk(kChunkBin, "ab", 8), {56 + 8}));
  EXPECT_THAT(all_codes(container), ElementsAre("|", "GLB_UNEXPECTED_END_OF_CHUNK_DATA@58"));
  EXPECT_THAT(container.late_errors[0].message, HasSubstr("8 bytes, but"));
  EXPECT_THAT(container.late_errors[0].message, HasSubstr("ends after 2"));
  EXPECT_TRUE(container.cut_short);
  EXPECT_EQ(*container.json, kJson);
  EXPECT_EQ(container.bin->length, 2U);
}

TEST(Glb, AFileThatEndsInAChunkHeaderIsCutShort) {
  const Container container = open_glb(glb(json_chunk() + "abc"));
  EXPECT_THAT(all_codes(container), ElementsAre("|", "GLB_UNEXPECTED_END_OF_CHUNK_HEADER@51"));
  EXPECT_THAT(container.late_errors[0].message, HasSubstr("ends after 3 bytes of"));
  EXPECT_TRUE(container.cut_short);
}

TEST(Glb, LengthsNearFourGibibytesDoNotWrap) {
  const Container container =
      open_glb(glb(json_chunk() + chunk(kChunkBin, "abcd", 0xFFFFFFFC), {0xFFFFFFFF}));
  EXPECT_THAT(all_codes(container),
              ElementsAre("GLB_CHUNK_TOO_BIG@48", "|", "GLB_UNEXPECTED_END_OF_CHUNK_DATA@60"));
  EXPECT_EQ(container.bin->length, 4U);
}

TEST(Glb, AFileOfNothingButChunkHeadersIsNotKeptWhole) {
  std::string chunks;
  for (std::size_t i = 0; i < kMaxChunks + 10; ++i) chunks += chunk(kChunkOther, "");
  const Container container = open_glb(glb(chunks));
  EXPECT_EQ(container.chunks.size(), kMaxChunks);
  EXPECT_EQ(codes(container.errors).back(),
            "GLB_TOO_MANY_CHUNKS@" + std::to_string(12 + 8 * kMaxChunks));
  EXPECT_THAT(container.errors.back().message, HasSubstr("last 80 bytes"));
  EXPECT_THAT(container.late_errors, IsEmpty());
}

TEST(Glb, ExactlyTheMostChunksAreNoError) {
  std::string chunks = json_chunk();
  for (std::size_t i = 1; i < kMaxChunks; ++i) chunks += chunk(kChunkOther, "");
  EXPECT_EQ(codes(open_glb(glb(chunks)).errors).back().substr(0, 23), "GLB_UNKNOWN_CHUNK_TYPE@");
}

TEST(Glb, EveryMessageIsASentenceAndEveryHelpToo) {
  const std::string everything =
      glb(chunk(kChunkOther, "a") + bin_chunk("") + chunk(kChunkJson, "") + json_chunk() +
              chunk(kChunkBin, "", 5),
          {11});
  const Container container = open_glb(everything);
  EXPECT_GE(container.errors.size(), 10U);
  for (const ContainerError& error : container.errors) {
    EXPECT_EQ(error.message.back(), '.') << code_name(error.code);
    EXPECT_NE(error.help.back(), '.') << code_name(error.code);
  }
}

}  // namespace
}  // namespace gltfx::container::test
