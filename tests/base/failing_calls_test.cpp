// SPDX-License-Identifier: Apache-2.0
// Files are replaced whole or not at all, whichever system call fails.
#include "base/support/failing_calls.hpp"

#include <cerrno>
#include <filesystem>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/xattr.h>
#include <unistd.h>

#include "base/replace_file.hpp"
#include "container/temp_folder.hpp"

namespace gltfx {
namespace {

namespace fs = std::filesystem;
using container::test::content_of;
using container::test::TempFolder;
using test::Call;
using test::FailingCall;
using testing::AnyOf;
using testing::HasSubstr;

TEST(FailingCalls, AReplacedFileIsTheOldOneOrTheNewOne) {
  const TempFolder folder;
  const fs::path file = folder.path() / "a.gltf";
  test::fail_each_call([&](Call call, int number) {
    folder.write("a.gltf", "old");
    ::setxattr(file.c_str(), "user.note", "x", 1, 0);  // where the file system has them
    const auto seen = file_state(file);
    FailingCall failing(call, number, EIO);
    const auto trouble = replace_file(file, "new", *seen);
    const bool failed = failing.stop();
    EXPECT_EQ(trouble.has_value(), failed);
    EXPECT_THAT(content_of(file), AnyOf("old", "new"));
    EXPECT_TRUE(trouble || content_of(file) == "new");
    EXPECT_EQ(folder.entries(), 1);
    return failed;
  });
}

TEST(FailingCalls, ANewFileIsWholeOrNotThere) {
  const TempFolder folder;
  const fs::path file = folder.path() / "a.gltf";
  test::fail_each_call([&](Call call, int number) {
    FailingCall failing(call, number, EIO);
    const auto trouble = write_file(file, "new");
    const bool failed = failing.stop();
    EXPECT_EQ(trouble.has_value(), failed);
    EXPECT_EQ(folder.entries(), fs::exists(file) ? 1 : 0);
    EXPECT_THAT(content_of(file), AnyOf("", "new"));
    fs::remove(file);
    return failed;
  });
}

TEST(FailingCalls, WritingGoesOnAfterASignal) {
  const TempFolder folder;
  FailingCall failing(Call::write, 1, EINTR);
  EXPECT_FALSE(write_file(folder.path() / "a.gltf", "new"));
  EXPECT_TRUE(failing.stop());
  EXPECT_EQ(content_of(folder.path() / "a.gltf"), "new");
}

// Root opens any folder, so a failing call replaces a missing permission.
TEST(FailingCalls, AFolderThatCannotBeOpenedIsSaidBeforeAnythingIsReplaced) {
  const TempFolder folder;
  const fs::path file = folder.path() / "a.gltf";
  int openings = 0;
  for (bool failed = true; failed; openings += failed ? 1 : 0) {
    folder.write("a.gltf", "old");
    const auto seen = file_state(file);
    FailingCall failing(Call::open, openings + 1, EACCES);
    const auto trouble = replace_file(file, "new", *seen);
    failed = failing.stop();
    EXPECT_EQ(content_of(file), trouble ? "old" : "new");
  }
  EXPECT_GE(openings, 2);  // the draft and the folder
}

// Some file systems cannot make anything durable, or cannot rename without replacing.
TEST(FailingCalls, WhatAFileSystemCannotDoIsDoneWithout) {
  const TempFolder folder;
  const fs::path file = folder.path() / "a.gltf";
  for (const int number : {1, 2}) {
    FailingCall failing(Call::fsync, number, EINVAL);
    EXPECT_FALSE(write_file(file, "new"));
    EXPECT_TRUE(failing.stop());
    fs::remove(file);
  }
  for (const int error : {EINVAL, ENOSYS}) {
    FailingCall failing(Call::renameat2, 1, error);
    EXPECT_FALSE(create_file(file, "new"));
    EXPECT_TRUE(failing.stop());
    EXPECT_EQ(content_of(file), "new");
    fs::remove(file);
  }
  folder.write("a.gltf", "old");
  FailingCall failing(Call::renameat2, 1, EINVAL);
  const auto trouble = create_file(file, "new");
  ASSERT_TRUE(trouble);
  EXPECT_THAT(trouble->message, HasSubstr("cannot create"));
  EXPECT_EQ(content_of(file), "old");
}

TEST(FailingCalls, ADeniedOwnerIsAnError) {
  if (::geteuid() != 0) GTEST_SKIP() << "only root owns files of others";
  const TempFolder folder;
  const fs::path file = folder.write("a.gltf", "old");
  ASSERT_EQ(::chown(file.c_str(), 12345, 12345), 0);
  const auto seen = file_state(file);
  ASSERT_TRUE(seen);
  FailingCall failing(Call::fchown, 1, EPERM);
  const auto trouble = replace_file(file, "new", *seen);
  ASSERT_TRUE(trouble);
  EXPECT_THAT(trouble->message, HasSubstr("keep the owner"));
  EXPECT_EQ(content_of(file), "old");
}

TEST(FailingCalls, AnAttributeThatCannotBeKeptIsSaidBeforeAnythingIsReplaced) {
  const TempFolder folder;
  const fs::path file = folder.write("a.gltf", "old");
  if (::setxattr(file.c_str(), "user.note", "mine", 4, 0) != 0) {
    GTEST_SKIP() << "the file system has no extended attributes";
  }
  const auto seen = file_state(file);
  ASSERT_TRUE(seen);
  FailingCall failing(Call::fsetxattr, 1, ENOSPC);
  const auto trouble = replace_file(file, "new", *seen);
  ASSERT_TRUE(trouble);
  EXPECT_THAT(trouble->message, HasSubstr("cannot keep the extended attribute 'user.note' of"));
  EXPECT_EQ(content_of(file), "old");
  EXPECT_EQ(folder.entries(), 1);
}

}  // namespace
}  // namespace gltfx
