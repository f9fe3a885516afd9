// SPDX-License-Identifier: Apache-2.0
// GLBs of version 3: lengths of 64 bits, chunks at multiples of 8, any number and order of them.
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/codes.hpp"
#include "container/glb3_builder.hpp"
#include "container/temp_folder.hpp"
#include "sanitized.hpp"

namespace gltfx::container::test {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

// 27 bytes, so that a gap follows.
const std::string kText = R"({"asset":{"version":"2.1"}})";
const Chunk3 kJsonOf3{kChunkJson, kText};
const Chunk3 kBinOf3{kChunkBin, "abcd"};

std::vector<std::string> errors_of(const Container& container) {
  std::vector<std::string> lines;
  for (const auto* errors : {&container.errors, &container.late_errors}) {
    for (const ContainerError& error : *errors) {
      lines.push_back(std::string(code_name(error.code)) + "@" + std::to_string(error.offset));
    }
  }
  return lines;
}

std::vector<std::string> errors_of(const std::string& bytes) { return errors_of(open_glb(bytes)); }

TEST(Glb3, HasTextAndAllChunks) {
  const Container container = open_glb(glb3({kJsonOf3, kBinOf3, kBinOf3}));
  EXPECT_THAT(errors_of(container), IsEmpty());
  EXPECT_EQ(container.glb_version, 3U);
  EXPECT_EQ(*container.json, kText);
  EXPECT_EQ(container.json_offset, 32U);
  ASSERT_EQ(container.chunks.size(), 3U);
  for (const Chunk& chunk : container.chunks) EXPECT_EQ(chunk.header_offset % 8, 0U);
  ASSERT_TRUE(container.bin);
  EXPECT_EQ(container.bin->offset, container.chunks[1].offset);
  EXPECT_EQ(container.bytes.part(container.bin->offset, container.bin->length).text(), "abcd");
}

TEST(Glb3, MayHaveChunksInAnyOrder) {
  const Chunk3 other{kChunkOther, "x", 7};
  EXPECT_THAT(errors_of(glb3({other, kJsonOf3, other, kBinOf3, other})), IsEmpty());
  const Container first = open_glb(glb3({kBinOf3, kJsonOf3}));
  EXPECT_THAT(errors_of(first), ElementsAre("GLB_CHUNK_ORDER@16"));
  EXPECT_EQ(*first.json, kText);
  EXPECT_FALSE(first.bin) << "only chunk 1 is implied, and only behind JSON";
  EXPECT_FALSE(open_glb(glb3({kJsonOf3, other, kBinOf3})).bin);
}

TEST(Glb3, TheFirstJsonIsThatOfTheAsset) {
  const Container two = open_glb(glb3({kJsonOf3, {kChunkJson, "[1]"}, kBinOf3}));
  EXPECT_THAT(errors_of(two), IsEmpty());
  EXPECT_EQ(*two.json, kText);
  EXPECT_THAT(errors_of(glb3({})), ElementsAre("GLB_NO_JSON_CHUNK@16"));
  EXPECT_THAT(errors_of(glb3({kBinOf3})), ElementsAre("GLB_NO_JSON_CHUNK@16"));
  EXPECT_THAT(errors_of(glb3({{kChunkJson, ""}})), ElementsAre("GLB_EMPTY_CHUNK@16"));
}

TEST(Glb3, HasZerosBetweenChunks) {
  EXPECT_THAT(errors_of(glb3({kJsonOf3, kBinOf3}, {}, ' ')), ElementsAre("GLB_CHUNK_GAP@59"));
  const std::string whole = glb3({kJsonOf3});
  EXPECT_THAT(errors_of(glb3({kJsonOf3}, whole.size() + 5) + std::string(5, '\0')), IsEmpty())
      << "a file may be padded";
}

TEST(Glb3, HasChunksWithoutEncoding) {
  EXPECT_THAT(errors_of(glb3({{kChunkJson, kText, 1}})),
              ElementsAre("GLB_CHUNK_ENCODING_UNKNOWN@20"));
  EXPECT_EQ(open_glb(glb3({{kChunkJson, kText, 1}})).json, nullptr);
  const Container bin = open_glb(glb3({kJsonOf3, {kChunkBin, "abcd", 1}}));
  EXPECT_THAT(errors_of(bin), IsEmpty()) << "a matter of the buffers";
  EXPECT_FALSE(bin.bin);
}

TEST(Glb3, IsAsLongAsItSays) {
  const std::string whole = glb3({kJsonOf3, kBinOf3});
  EXPECT_THAT(errors_of(glb3({kJsonOf3, kBinOf3}, whole.size() + 1)),
              ElementsAre("GLB_LENGTH_MISMATCH@8"));
  for (const unsigned bit : {32U, 63U}) {
    EXPECT_THAT(errors_of(glb3({kJsonOf3, kBinOf3}, whole.size() | std::uint64_t{1} << bit)),
                ElementsAre("GLB_LENGTH_MISMATCH@8"))
        << "no layout of version 2";
  }
  EXPECT_THAT(errors_of(whole + "x"),
              ElementsAre("GLB_EXTRA_DATA@" + std::to_string(whole.size())));
  EXPECT_THAT(errors_of(glb3({kJsonOf3}, 8)),
              ElementsAre("GLB_LENGTH_TOO_SMALL@8", "GLB_EXTRA_DATA@8", "GLB_NO_JSON_CHUNK@16"));
}

TEST(Glb3, CutAnywhereIsCutShort) {
  const std::string whole = glb3({kJsonOf3, kBinOf3});
  for (std::size_t size = 8; size < whole.size(); ++size) {
    const Container container = open_glb(whole.substr(0, size));
    EXPECT_THAT(errors_of(container), testing::Not(IsEmpty())) << size;
    for (const Chunk& chunk : container.chunks) EXPECT_LE(chunk.offset + chunk.length, size);
  }
}

// 2^63 and other lengths that no file has.
TEST(Glb3, HostileLengthsAreErrors) {
  constexpr std::uint64_t kTopBit = std::uint64_t{1} << 63U;
  for (const std::uint64_t length : {kTopBit, kTopBit - 1, UINT64_MAX, UINT64_MAX - 31}) {
    Chunk3 json = kJsonOf3;
    json.length = length;
    const Container container = open_glb(glb3({json}));
    EXPECT_THAT(errors_of(container),
                ElementsAre("GLB_CHUNK_TOO_BIG@16", "GLB_UNEXPECTED_END_OF_CHUNK_DATA@59"));
    EXPECT_TRUE(container.cut_short);
    EXPECT_EQ(container.json, nullptr);
    EXPECT_THAT(errors_of(glb3({kJsonOf3}, length)), ElementsAre("GLB_LENGTH_MISMATCH@8"));
  }
}

TEST(Glb3, OneErrorForVeryManyChunks) {
  if (kSanitized) GTEST_SKIP() << "takes ten times as long there";
  std::string bytes = glb3({kJsonOf3});
  bytes.resize((bytes.size() + 7) / 8 * 8);
  const std::string empty = header_of({kChunkOther, ""});
  for (std::size_t i = 0; i < kMaxChunksOfVersion3; ++i) bytes += empty;
  bytes.replace(8, 8, little_endian_64(bytes.size()));
  const Container container = open_glb(bytes);
  EXPECT_EQ(container.chunks.size(), kMaxChunksOfVersion3);
  ASSERT_EQ(container.errors.size(), 1U);
  EXPECT_EQ(container.errors[0].code, Code::GLB_TOO_MANY_CHUNKS);
}

TEST(Glb3, ReadersOfVersion2SeeAnUnknownVersion) {
  const Container literal = literal_reading(open_glb(glb3({kJsonOf3})));
  EXPECT_THAT(errors_of(literal), ElementsAre("GLB_INVALID_VERSION@4"));
  EXPECT_EQ(literal.json, nullptr);
}

TEST(Glb3, WithTheLayoutOfVersion2IsNamed) {
  GlbHeader header;
  header.version = 3;
  EXPECT_THAT(errors_of(glb(json_chunk() + bin_chunk(), header)),
              testing::Contains("GLB_INVALID_VERSION@4"));
}

// More than 4 GiB: the file has holes in place of zeros, so that it takes no room.
TEST(Glb3, MayExceed4GiB) {
  constexpr std::uint64_t kLength = (std::uint64_t{5} << 30U) + 4;
  const std::string json = R"({"asset":{"version":"2.1"},"buffers":[{"byteLength":4,"chunk":2}]})";
  std::string head = glb3({{kChunkJson, json}, {kChunkBin, "", 0, kLength}});
  const std::uint64_t last = (head.size() + kLength + 7) / 8 * 8;
  const Chunk3 tail{kChunkBin, "tail"};
  head.replace(8, 8, little_endian_64(last + header_of(tail).size() + tail.data.size()));
  const TempFolder folder;
  const std::filesystem::path path = folder.write("large.glb", head);
  {
    std::fstream file(path, std::ios::binary | std::ios::in | std::ios::out);
    file.seekp(static_cast<std::streamoff>(last));
    file << header_of(tail) << tail.data;
  }
  const Result<Container> container = open_file(path);
  ASSERT_TRUE(container) << container.error().message;
  EXPECT_THAT(errors_of(*container), IsEmpty());
  ASSERT_EQ(container->chunks.size(), 3U);
  EXPECT_EQ(container->chunks[1].length, kLength);
  const Chunk& found = container->chunks[2];
  EXPECT_EQ(container->bytes.part(found.offset, found.length).text(), "tail");
}

}  // namespace
}  // namespace gltfx::container::test
