// SPDX-License-Identifier: Apache-2.0
#include <string>

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "container/bytes.hpp"
#include "container/file.hpp"
#include "container/temp_folder.hpp"

namespace gltfx::container::test {
namespace {

Bytes text(std::string words) { return Bytes::from_string(std::move(words)); }

TEST(Pieces, AreWrittenOneBehindTheOther) {
  const TempFolder folder;
  const std::string large(3'000'000, 'x');
  const auto old = folder.write("old", large + "behind");
  const Loaded loaded = load_file(open_regular(AT_FDCWD, old.c_str()));
  const std::vector<Bytes> pieces{
      text("head"), loaded.bytes.part(1, loaded.bytes.size() - 1), {}, text("tail")};
  FileDraft draft(folder.path() / "new", std::nullopt);
  EXPECT_FALSE(write_pieces(draft, pieces));
  EXPECT_FALSE(draft.finish());
  EXPECT_FALSE(draft.publish());
  const std::string expected = "head" + large.substr(1) + "behindtail";
  EXPECT_TRUE(content_of(folder.path() / "new") == expected);
  EXPECT_TRUE(join(pieces) == expected);
}

TEST(Pieces, OfAFileThatBecameShorterAreAnError) {
  const TempFolder folder;
  const auto old = folder.write("old", std::string(1U << 20U, 'x'));
  const Loaded loaded = load_file(open_regular(AT_FDCWD, old.c_str()));
  std::filesystem::resize_file(old, 100);
  FileDraft draft(folder.path() / "new", std::nullopt);
  const auto trouble = write_pieces(draft, {loaded.bytes});
  ASSERT_TRUE(trouble);
  EXPECT_THAT(trouble->message, testing::HasSubstr("became shorter"));
}

TEST(Pieces, BytesAreComparedToTheirEnd) {
  const std::string large(3'000'000, 'x');
  EXPECT_TRUE(same_bytes(text(large), text(large)));
  EXPECT_TRUE(same_bytes(Bytes(), Bytes()));
  EXPECT_FALSE(same_bytes(text(large), text(large + "x")));
  std::string other = large;
  other.back() = 'y';
  EXPECT_FALSE(same_bytes(text(large), text(other)));
}

TEST(Pieces, AreComparedWithAWhole) {
  using Pieces = std::vector<Bytes>;
  EXPECT_TRUE(same_bytes(Pieces{text("ab"), text(""), text("c")}, text("abc")));
  EXPECT_FALSE(same_bytes(Pieces{text("ab"), text("d")}, text("abc")));
  EXPECT_FALSE(same_bytes(Pieces{text("ab")}, text("abc")));
  EXPECT_FALSE(same_bytes(Pieces{text("ab"), text("cd")}, text("abc")));
}

TEST(Pieces, ManyLargeOnesLieInAFileWithoutAName) {
  const TempFolder folder;
  const std::string half(std::size_t{9} << 20U, 'x');
  const Bytes whole = gathered({text(half), text("|"), text(half)}, folder.path());
  EXPECT_TRUE(whole.text() == half + "|" + half);
  EXPECT_EQ(folder.entries(), 0);
  // Where there can be no file they are copied.
  EXPECT_TRUE(gathered({text(half), text(half)}, folder.path() / "none").text() == half + half);
  EXPECT_EQ(gathered({text("a"), text("b")}, std::filesystem::path()).text(), "ab");
}

}  // namespace
}  // namespace gltfx::container::test
