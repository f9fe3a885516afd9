// SPDX-License-Identifier: Apache-2.0
#include "base/replace_file.hpp"

#include <algorithm>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/temporary_file.hpp"
#include "container/temp_folder.hpp"

namespace gltfx {
namespace {

namespace fs = std::filesystem;
using container::test::content_of;
using container::test::TempFolder;
using testing::HasSubstr;

struct stat status_of(const fs::path& path) {
  struct stat status {};
  ::stat(path.c_str(), &status);
  return status;
}

TEST(ReplaceFile, PutsNewBytesInPlaceAndKeepsTheMode) {
  const TempFolder folder;
  const fs::path file = folder.write("a.gltf", "old");
  ::chmod(file.c_str(), 0640);
  const auto before = status_of(file);
  const std::string bytes(300'000, 'n');
  const auto seen = file_state(file);
  ASSERT_TRUE(seen);
  EXPECT_FALSE(replace_file(file, bytes, *seen));
  EXPECT_EQ(content_of(file), bytes);
  EXPECT_EQ(status_of(file).st_mode & 07777U, 0640U);
  EXPECT_NE(status_of(file).st_ino, before.st_ino);
  EXPECT_EQ(folder.entries(), 1);
}

TEST(ReplaceFile, ASymbolicLinkStaysAndItsTargetIsReplaced) {
  const TempFolder folder;
  folder.write("real/a.gltf", "old");
  folder.link("a.gltf", "real/a.gltf");
  EXPECT_FALSE(write_file(folder.path() / "a.gltf", "new"));
  EXPECT_TRUE(fs::is_symlink(folder.path() / "a.gltf"));
  EXPECT_EQ(content_of(folder.path() / "real/a.gltf"), "new");
}

void expect_refused(const TempFolder& folder, const fs::path& file, const FileState& seen,
                    const std::string& why) {
  const std::string before = content_of(file);
  const auto count = folder.entries();
  const auto trouble = replace_file(file, "new", seen);
  ASSERT_TRUE(trouble);
  EXPECT_THAT(trouble->message, HasSubstr(why));
  EXPECT_EQ(content_of(file), before);
  EXPECT_EQ(folder.entries(), count);
}

TEST(ReplaceFile, RefusesAFileThatSomebodyChanged) {
  const TempFolder folder;
  const fs::path file = folder.write("a.gltf", "old");
  const auto seen = file_state(file);
  ASSERT_TRUE(seen);
  folder.write("a.gltf", "old and longer");
  expect_refused(folder, file, *seen, "changed by another program");
}

TEST(ReplaceFile, RefusesAFileWithTheSameSizeAndTimeButAnotherInode) {
  const TempFolder folder;
  const fs::path file = folder.write("a.gltf", "old");
  const auto seen = file_state(file);
  const fs::path other = folder.write("b.gltf", "odd");
  fs::last_write_time(other, fs::last_write_time(file));
  fs::rename(other, file);
  expect_refused(folder, file, *seen, "changed by another program");
}

TEST(ReplaceFile, RefusesHardLinks) {
  const TempFolder folder;
  const fs::path file = folder.write("a.gltf", "old");
  fs::create_hard_link(file, folder.path() / "b.gltf");
  expect_refused(folder, file, *file_state(file), "other hard links");
}

TEST(ReplaceFile, RefusesReadOnlyFiles) {
  const TempFolder folder;
  const fs::path file = folder.write("a.gltf", "old");
  ::chmod(file.c_str(), 0444);
  expect_refused(folder, file, *file_state(file), "read-only");
}

TEST(ReplaceFile, WhatIsNotThereOrNoFileCannotBeReplaced) {
  const TempFolder folder;
  EXPECT_THAT(check_replaceable(folder.path(), {})->message, HasSubstr("not a regular file"));
  EXPECT_THAT(check_replaceable(folder.path() / "none", {})->message, HasSubstr("cannot examine"));
  EXPECT_THAT(replace_file(folder.path() / "none", "new", {})->message,
              HasSubstr("cannot examine"));
}

TEST(ReplaceFile, OwnerAndGroupAreKept) {
  if (::geteuid() != 0) GTEST_SKIP() << "only root owns files of others";
  const TempFolder folder;
  for (const uid_t user : {0U, 12345U}) {
    const fs::path file = folder.write("a.gltf", "old");
    ASSERT_EQ(::chown(file.c_str(), user, 54321), 0);
    EXPECT_FALSE(write_file(file, "new"));
    EXPECT_EQ(status_of(file).st_uid, user);
    EXPECT_EQ(status_of(file).st_gid, 54321U);
  }
}

TEST(ReplaceFile, OnlyRegularFilesHaveAState) {
  const TempFolder folder;
  ASSERT_EQ(::mkfifo((folder.path() / "pipe").c_str(), 0600), 0);
  EXPECT_FALSE(file_state(folder.path() / "pipe"));
  EXPECT_FALSE(file_state(folder.path()));
  EXPECT_FALSE(file_state(folder.path() / "nothing"));
  EXPECT_TRUE(write_file(folder.path() / "pipe", "new"));
}

TEST(CreateFile, MakesANewFileAndNeverReplacesOne) {
  const TempFolder folder;
  const fs::path file = folder.path() / "a.gltf";
  EXPECT_FALSE(create_file(file, "first"));
  const auto trouble = create_file(file, "second");
  ASSERT_TRUE(trouble);
  EXPECT_THAT(trouble->message, HasSubstr("cannot create"));
  EXPECT_EQ(content_of(file), "first");
  EXPECT_EQ(folder.entries(), 1);
  EXPECT_TRUE(create_file(folder.path() / "missing" / "a.gltf", "x"));
}

TEST(CreateFile, APathMayBeRelative) {
  const TempFolder folder;
  const fs::path before = fs::current_path();
  fs::current_path(folder.path());
  EXPECT_FALSE(create_file("a.gltf", "new"));
  fs::current_path(before);
  EXPECT_EQ(content_of(folder.path() / "a.gltf"), "new");
}

TEST(CreateFile, NamesOfTemporaryFilesMayBeTaken) {
  const TempFolder folder;
  const fs::path file = folder.path() / "a.gltf";
  const fs::path taken = temporary_name(file, 0);
  folder.write(taken.filename(), "theirs");
  EXPECT_FALSE(create_file(file, "new"));
  EXPECT_EQ(content_of(file), "new");
  EXPECT_EQ(content_of(taken), "theirs");
}

TEST(TemporaryFiles, BeyondTheFirst64AreForgotten) {
  const TempFolder folder;
  std::vector<fs::path> paths;
  std::vector<std::unique_ptr<TemporaryName>> names;
  for (int i = 0; i < 70; ++i) {
    paths.push_back(folder.write(std::to_string(i), "x"));
    names.push_back(std::make_unique<TemporaryName>(paths.back().native()));
  }
  remove_temporaries();
  EXPECT_EQ(
      std::count_if(paths.begin(), paths.end(), [](const auto& path) { return fs::exists(path); }),
      6);
}

TEST(TemporaryFiles, AreRemovedWhileTheyAreKnown) {
  const TempFolder folder;
  const std::string path = folder.write("a.part", "x").native();
  {
    const TemporaryName name(path);
    const TemporaryName too_long(std::string(5000, 'x'));
    remove_temporaries();
    EXPECT_FALSE(fs::exists(path));
    folder.write("a.part", "x");
  }
  remove_temporaries();
  EXPECT_TRUE(fs::exists(path));
}

TEST(WriteFile, CreatesOrReplaces) {
  const TempFolder folder;
  const fs::path file = folder.path() / "a.gltf";
  EXPECT_FALSE(write_file(file, "first"));
  EXPECT_FALSE(write_file(file, "second"));
  EXPECT_EQ(content_of(file), "second");
  EXPECT_EQ(folder.entries(), 1);
}

}  // namespace
}  // namespace gltfx
