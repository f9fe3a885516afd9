// SPDX-License-Identifier: Apache-2.0
#include <cstddef>
#include <string>

#include <fcntl.h>
#include <gtest/gtest.h>

#include "container/file.hpp"
#include "container/glb.hpp"
#include "container/glb_builder.hpp"
#include "container/temp_folder.hpp"

namespace gltfx::container::test {
namespace {

std::string whole_file() { return glb(json_chunk() + bin_chunk("12345678")); }

std::string expected_code(std::size_t size) {
  if (size < 12) return "GLB_UNEXPECTED_END_OF_HEADER";
  if (size == 12 || size == 48) return "GLB_LENGTH_MISMATCH";
  if (size < 20 || (size > 48 && size < 56)) return "GLB_UNEXPECTED_END_OF_CHUNK_HEADER";
  return "GLB_UNEXPECTED_END_OF_CHUNK_DATA";
}

void expect_truncated(const Container& container, std::size_t size) {
  ASSERT_EQ(container.late_errors.size(), 1U) << size;
  EXPECT_EQ(code_name(container.late_errors[0].code), expected_code(size)) << size;
  EXPECT_EQ(container.late_errors[0].offset, size);
  EXPECT_TRUE(container.errors.empty()) << size;
  EXPECT_EQ(container.cut_short, expected_code(size) != "GLB_LENGTH_MISMATCH") << size;
  EXPECT_EQ(container.json != nullptr, size >= 48) << size;
  for (const Chunk& chunk : container.chunks) EXPECT_LE(chunk.offset + chunk.length, size);
}

TEST(GlbTruncation, EveryLengthInMemoryHasOneErrorAtItsEnd) {
  const std::string whole = whole_file();
  ASSERT_EQ(whole.size(), 64U);
  for (std::size_t size = 0; size < whole.size(); ++size) {
    expect_truncated(open_glb(whole.substr(0, size)), size);
  }
}

TEST(GlbTruncation, EveryLengthOnDiskHasOneErrorAtItsEnd) {
  const TempFolder folder;
  const std::string whole = whole_file();
  for (std::size_t size = 0; size < whole.size(); ++size) {
    const auto container = open_file(folder.write("cut.glb", whole.substr(0, size)));
    ASSERT_TRUE(container);
    expect_truncated(*container, size);
  }
}

TEST(GlbTruncation, ACutJsonChunkIsNotReadAsText) {
  EXPECT_EQ(open_glb(whole_file().substr(0, 47)).json, nullptr);
  EXPECT_EQ(*open_glb(whole_file().substr(0, 48)).json, kJson);
}

TEST(GlbTruncation, AFileThatShrinksWhileItIsReadIsAReadErrorAtEveryStep) {
  const TempFolder folder;
  const std::string whole = whole_file();
  for (const std::size_t left : {0U, 11U, 12U, 19U, 20U, 47U, 48U, 55U}) {
    const File file =
        open_regular(AT_FDCWD, folder.write("shrunk.glb", whole.substr(0, left)).c_str());
    ASSERT_EQ(file.error, ResolveError::none);
    Container container;
    const auto error = read_glb(Source(file.fd.get(), whole.size()), container);
    ASSERT_TRUE(error) << left;
    EXPECT_EQ(error->error, ResolveError::truncated) << left;
  }
}

TEST(GlbTruncation, BinDataIsNotReadWhenTheFileIsOpened) {
  const TempFolder folder;
  const std::string whole = whole_file();
  const File file = open_regular(AT_FDCWD, folder.write("shrunk.glb", whole.substr(0, 56)).c_str());
  Container container;
  EXPECT_FALSE(read_glb(Source(file.fd.get(), whole.size()), container));
  EXPECT_EQ(container.bin->length, 8U);
}

}  // namespace
}  // namespace gltfx::container::test
