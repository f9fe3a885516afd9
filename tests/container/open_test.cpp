// SPDX-License-Identifier: Apache-2.0
#include <cerrno>
#include <filesystem>
#include <memory>
#include <string>

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/mman.h>
#include <sys/stat.h>

#include "container/file.hpp"
#include "container/glb_builder.hpp"
#include "container/temp_folder.hpp"

namespace gltfx::container::test {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

Format format_of(std::string_view bytes, std::string_view name = {}) {
  return open_bytes(Bytes::from_string(std::string(bytes)), name).format;
}

constexpr std::string_view kPointer =
    "version https://git-lfs.github.com/spec/v1\noid sha256:00\nsize 12345\n";

std::string message_of(const std::filesystem::path& path, const OpenLimits& limits = {}) {
  const auto container = open_file(path, limits);
  return container ? "no error" : container.error().message;
}

TEST(Sniff, BytesTellTheFormat) {
  EXPECT_EQ(format_of(""), Format::empty);
  EXPECT_EQ(format_of("glTF"), Format::glb);
  EXPECT_EQ(format_of("glT"), Format::glb);
  EXPECT_EQ(format_of("glTX\n"), Format::gltf);
  EXPECT_EQ(format_of(kPointer), Format::git_lfs_pointer);
  EXPECT_EQ(format_of("{\0\0"), Format::gltf);
  EXPECT_EQ(format_of(" \r\n\t{}"), Format::gltf);
  EXPECT_EQ(format_of("\xEF\xBB\xBF{}"), Format::gltf);
  EXPECT_EQ(format_of("\xFF\xFE{"), Format::gltf);
  EXPECT_EQ(format_of(std::string_view("\xFE\xFF\0{", 4)), Format::gltf);
  EXPECT_EQ(format_of("materials: none"), Format::gltf);
  EXPECT_EQ(format_of("[\xC3\xA4]"), Format::gltf);
  EXPECT_EQ(format_of("\x89PNG\r\n\x1A\n"), Format::unknown);
  EXPECT_EQ(format_of(std::string("PK\x03\x04", 4)), Format::unknown);
  EXPECT_EQ(format_of(std::string("abc\0def", 7)), Format::unknown);
}

TEST(Sniff, TheNameDecidesOnlyWhereTheBytesAreNothingKnown) {
  EXPECT_EQ(format_of("", "A.GLB"), Format::glb);
  EXPECT_EQ(format_of("\x89PNG\r\n\x1A\n", "a.glb"), Format::glb);
  EXPECT_EQ(format_of("<!DOCTYPE html>", "a.glb"), Format::glb);
  EXPECT_EQ(format_of("{}", "a.glb"), Format::gltf);
  EXPECT_EQ(format_of(kPointer, "a.glb"), Format::git_lfs_pointer);
  EXPECT_EQ(format_of("glTF", "a.gltf"), Format::glb);
  EXPECT_EQ(format_of("\x89PNG\r\n\x1A\n", "a.gltf"), Format::unknown);
  EXPECT_EQ(format_of("\x89PNG\r\n\x1A\n", "glb"), Format::unknown);
}

TEST(Sniff, ALongTextThatBeginsLikeAPointerIsNone) {
  std::string text(kPointer);
  text.resize(1024, 'x');
  EXPECT_EQ(format_of(text), Format::gltf);
  text.resize(1023);
  EXPECT_EQ(format_of(text), Format::git_lfs_pointer);
}

TEST(OpenBytes, JsonIsACopyOfTheBytes) {
  const Container container = open_bytes(Bytes::from_string("{}"));
  EXPECT_EQ(*container.json, "{}");
  EXPECT_EQ(container.bytes.text(), "{}");
  EXPECT_NE(container.json->data(), container.bytes.text().data());
  EXPECT_EQ(container.json_offset, 0U);
}

TEST(OpenFile, SmallAndLargeTextIsReadWhole) {
  const TempFolder folder;
  for (const std::size_t size : {2U, 16384U, 16385U, 200000U}) {
    std::string text(size, ' ');
    text.front() = '{';
    text.back() = '}';
    const auto container = open_file(folder.write("a.gltf", text));
    ASSERT_TRUE(container);
    EXPECT_EQ(container->format, Format::gltf);
    EXPECT_TRUE(*container->json == text);
    EXPECT_TRUE(container->bytes.text() == text);
  }
}

TEST(OpenFile, SmallAndLargeGlbsAreTakenApart) {
  const TempFolder folder;
  for (const std::size_t size : {4U, 16U * 1024U, 1024U * 1024U}) {
    const std::string data(size, 'b');
    const auto container = open_file(folder.write("a.bin", glb(json_chunk() + bin_chunk(data))));
    ASSERT_TRUE(container);
    EXPECT_EQ(container->format, Format::glb);
    EXPECT_EQ(*container->json, kJson);
    EXPECT_TRUE(container->bytes.part(container->bin->offset, container->bin->length).text() ==
                data);
    EXPECT_TRUE(container->errors.empty() && container->late_errors.empty());
  }
}

TEST(OpenFile, LargeBinaryJunkIsUnknownAndItsBytesAreThere) {
  const TempFolder folder;
  const std::string junk(20000, '\1');
  const auto container = open_file(folder.write("a.fbx", junk));
  ASSERT_TRUE(container);
  EXPECT_EQ(container->format, Format::unknown);
  EXPECT_TRUE(container->bytes.text() == junk);
  EXPECT_EQ(container->json, nullptr);
}

TEST(OpenFile, TheNameMakesLargeJunkAGlb) {
  const TempFolder folder;
  const auto container = open_file(folder.write("a.glb", std::string(20000, '\1')));
  ASSERT_TRUE(container);
  EXPECT_EQ(code_name(container->errors.at(0).code), "GLB_INVALID_MAGIC");
}

TEST(OpenFile, AnEmptyFileIsEmpty) {
  const TempFolder folder;
  const auto container = open_file(folder.write("a.gltf", ""));
  ASSERT_TRUE(container);
  EXPECT_EQ(container->format, Format::empty);
  EXPECT_TRUE(container->bytes.empty());
}

TEST(OpenFile, WhatIsNoReadableFileIsAnErrorThatSaysSo) {
  const TempFolder folder;
  EXPECT_THAT(message_of(folder.path() / "none.gltf"), HasSubstr("none.gltf' does not exist;"));
  EXPECT_THAT(message_of(folder.path()), HasSubstr("is not a regular file: it is a folder;"));
  EXPECT_THAT(message_of("/dev/zero"), HasSubstr("it is a device;"));
  EXPECT_THAT(message_of(""), HasSubstr("does not exist"));
}

TEST(OpenFile, AFifoDoesNotBlock) {
  const TempFolder folder;
  const std::filesystem::path fifo = folder.path() / "pipe.glb";
  ASSERT_EQ(::mkfifo(fifo.c_str(), 0600), 0);
  EXPECT_THAT(message_of(fifo), HasSubstr("it is a pipe;"));
}

TEST(OpenFile, ALinkToAFileIsFollowed) {
  const TempFolder folder;
  folder.write("real.gltf", "{}");
  folder.link("link.gltf", "real.gltf");
  const auto container = open_file(folder.path() / "link.gltf");
  ASSERT_TRUE(container);
  EXPECT_EQ(*container->json, "{}");
}

TEST(OpenFile, AFileLargerThanTheLimitIsRefused) {
  const TempFolder folder;
  const auto file = folder.write("a.gltf", "{   }");
  EXPECT_EQ(message_of(file, {5}), "no error");
  EXPECT_THAT(message_of(file, {4}), HasSubstr("it has 5 bytes, the limit is 4;"));
}

TEST(OpenFile, JsonBeyondFourGibibytesIsRefusedBeforeItIsRead) {
  const TempFolder folder;
  const auto file = folder.write("huge.gltf", "{");
  std::filesystem::resize_file(file, (std::uintmax_t{1} << 32U) + 1);  // sparse
  EXPECT_THAT(message_of(file), HasSubstr("too large"));
}

TEST(OpenFile, NamesInErrorsAreNeutralised) {
  EXPECT_THAT(message_of("/no/\x1b[31mred"), testing::Not(HasSubstr("\x1b")));
}

TEST(CopyRange, AFileThatBecameShorterIsTruncated) {
  const TempFolder folder;
  const File file = open_regular(AT_FDCWD, folder.write("a", "12345").c_str());
  EXPECT_EQ(*copy_range(file.fd.get(), 1, 4).text, "2345");
  const Copied cut = copy_range(file.fd.get(), 2, 4);
  EXPECT_EQ(cut.error, ResolveError::truncated);
  EXPECT_EQ(cut.problem, "it ends at byte 5, expected 6");
}

TEST(CopyRange, AnImpossibleSizeIsAnErrorAndNoCrash) {
  const TempFolder folder;
  const File file = open_regular(AT_FDCWD, folder.write("a", "12345").c_str());
  EXPECT_EQ(copy_range(file.fd.get(), 0, UINT64_MAX).error, ResolveError::too_large);
}

TEST(LoadFile, NothingIsMappedOfNothing) {
  const TempFolder folder;
  const File file = open_regular(AT_FDCWD, folder.write("a", "").c_str());
  const Loaded loaded = map_file(file.fd.get(), 0);
  EXPECT_EQ(loaded.error, ResolveError::none);
  EXPECT_TRUE(loaded.bytes.text().empty());
  EXPECT_EQ(load_file(file_error(ENOENT)).error, ResolveError::not_found);
}

// Addresses only: of the four gibibytes one page is touched.
TEST(OpenBytes, JsonBeyondFourGibibytesIsNoText) {
  constexpr std::size_t kSize = (std::size_t{1} << 32U) + 1;
  void* const memory = ::mmap(nullptr, kSize, PROT_READ | PROT_WRITE,
                              MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
  ASSERT_NE(memory, MAP_FAILED);
  static_cast<char*>(memory)[0] = '{';
  const std::shared_ptr<void> owner(memory, [](void* mapped) { ::munmap(mapped, kSize); });
  const Container container =
      open_bytes(Bytes({static_cast<const std::byte*>(memory), kSize}, owner), "a.gltf");
  EXPECT_EQ(container.format, Format::gltf);
  EXPECT_FALSE(container.json);
}

TEST(LoadFile, SmallFilesDoNotChangeUnderTheirReader) {
  const TempFolder folder;
  const auto path = folder.write("a", std::string(kCopyBelow, 'a'));
  const Loaded loaded = load_file(open_regular(AT_FDCWD, path.c_str()));
  std::filesystem::resize_file(path, 0);
  EXPECT_EQ(loaded.bytes.text().back(), 'a');
}

}  // namespace
}  // namespace gltfx::container::test
