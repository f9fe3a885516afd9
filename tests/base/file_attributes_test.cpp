// SPDX-License-Identifier: Apache-2.0
// Attributes of a file when another one replaces it.
#include <cerrno>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <sys/xattr.h>
#include <unistd.h>

#include "base/replace_file.hpp"
#include "container/temp_folder.hpp"

namespace gltfx {
namespace {

namespace fs = std::filesystem;
using container::test::content_of;
using container::test::TempFolder;

constexpr const char* kAccess = "system.posix_acl_access";
constexpr const char* kDefault = "system.posix_acl_default";

// user::rw-, user 12345 read and write, group::---, mask rw-, other::---, as Linux stores it.
std::string access_list() {
  struct Entry {
    unsigned tag, permissions, id;
  };
  constexpr unsigned kNobody = 0xFFFFFFFF;
  std::string list("\2\0\0\0", 4);
  const auto put = [&](unsigned value, unsigned bytes) {
    for (unsigned i = 0; i < bytes; ++i) list += static_cast<char>((value >> (8U * i)) & 0xFFU);
  };
  for (const Entry& entry :
       {Entry{0x01, 6, kNobody}, Entry{0x02, 6, 12345}, Entry{0x04, 0, kNobody},
        Entry{0x10, 6, kNobody}, Entry{0x20, 0, kNobody}}) {
    put(entry.tag, 2);
    put(entry.permissions, 2);
    put(entry.id, 4);
  }
  return list;
}

bool set(const fs::path& path, const char* name, const std::string& value) {
  return ::setxattr(path.c_str(), name, value.data(), value.size(), 0) == 0;
}

std::optional<std::string> get(const fs::path& path, const char* name) {
  std::string value(65536, '\0');
  const ssize_t size = ::getxattr(path.c_str(), name, value.data(), value.size());
  if (size < 0) return std::nullopt;
  value.resize(static_cast<std::size_t>(size));
  return value;
}

unsigned mode_of(const fs::path& path) {
  struct stat status {};
  EXPECT_EQ(::stat(path.c_str(), &status), 0) << path;
  return status.st_mode & 07777U;
}

fs::path draft_in(const TempFolder& folder) {
  for (const auto& entry : fs::directory_iterator(folder.path())) {
    if (entry.path().extension() == ".part") return entry.path();
  }
  return {};
}

TEST(FileAttributes, ExtendedAttributesAreKept) {
  const TempFolder folder;
  const fs::path file = folder.write("a.glb", "old");
  const std::string large(1500, 'x');
  if (!set(file, "user.note", "mine")) GTEST_SKIP() << "the file system has none";
  ASSERT_TRUE(set(file, "user.large", large) && set(file, "user.empty", ""));
  EXPECT_FALSE(write_file(file, "new"));
  EXPECT_EQ(content_of(file), "new");
  EXPECT_EQ(get(file, "user.note"), "mine");
  EXPECT_EQ(get(file, "user.large"), large);
  EXPECT_EQ(get(file, "user.empty"), "");
}

TEST(FileAttributes, AnAccessControlListIsKept) {
  const TempFolder folder;
  const fs::path file = folder.write("a.glb", "old");
  if (!set(file, kAccess, access_list())) GTEST_SKIP() << "the file system has no such lists";
  EXPECT_FALSE(write_file(file, "new"));
  EXPECT_EQ(get(file, kAccess), access_list());
  EXPECT_EQ(mode_of(file), 0660U);
}

// Attributes that new files inherit would give access to users without access to the old file.
TEST(FileAttributes, AListThatTheFolderGivesIsNotTakenOver) {
  const TempFolder folder;
  const fs::path file = folder.write("a.glb", "old");
  ::chmod(file.c_str(), 0640);
  if (!set(folder.path(), kDefault, access_list())) GTEST_SKIP() << "no such lists here";
  EXPECT_FALSE(write_file(file, "new"));
  EXPECT_EQ(get(file, kAccess), std::nullopt);
  EXPECT_EQ(mode_of(file), 0640U);
  EXPECT_FALSE(write_file(folder.path() / "b.glb", "new"));
  EXPECT_TRUE(get(folder.path() / "b.glb", kAccess));
}

TEST(FileAttributes, ADraftIsForItsUserOnlyUntilItIsFinished) {
  const TempFolder folder;
  for (const unsigned mode : {0600U, 0640U, 0666U, 0755U}) {
    const fs::path file = folder.write("a.glb", "old");
    ::chmod(file.c_str(), mode);
    FileDraft draft(file, *file_state(file));
    EXPECT_FALSE(draft.write("new"));
    EXPECT_EQ(mode_of(draft_in(folder)), 0600U);
    EXPECT_FALSE(draft.finish());
    EXPECT_EQ(mode_of(draft_in(folder)), mode);
    EXPECT_FALSE(draft.publish());
    EXPECT_EQ(mode_of(file), mode);
    EXPECT_EQ(content_of(file), "new");
  }
}

TEST(FileAttributes, ACopyLooksLikeItsOriginal) {
  const TempFolder folder;
  const fs::path file = folder.write("a.glb", "old");
  const fs::path copy = folder.path() / "a.glb.bak";
  const bool has_attributes = set(file, "user.note", "mine");
  ::chmod(file.c_str(), 0600);
  FileDraft draft(copy, file);
  EXPECT_FALSE(draft.write("old"));
  EXPECT_FALSE(draft.finish());
  EXPECT_FALSE(draft.publish());
  EXPECT_EQ(mode_of(copy), 0600U);
  EXPECT_EQ(get(copy, "user.note").has_value(), has_attributes);
  FileDraft again(copy, file);
  EXPECT_FALSE(again.write("other"));
  EXPECT_FALSE(again.finish());
  EXPECT_TRUE(again.publish());
  EXPECT_EQ(content_of(copy), "old");
  EXPECT_TRUE(FileDraft(folder.path() / "c", folder.path() / "none").write(""));
}

TEST(FileAttributes, ADraftCanBeReadBeforeItIsPublished) {
  const TempFolder folder;
  FileDraft draft(folder.path() / "a.glb", std::nullopt);
  EXPECT_FALSE(draft.write("one"));
  EXPECT_FALSE(draft.write("two"));
  const UniqueFd reader = draft.reader();
  std::string bytes(7, '\0');
  EXPECT_EQ(::pread(reader.get(), bytes.data(), bytes.size(), 0), 6);
  EXPECT_EQ(bytes.substr(0, 6), "onetwo");
  EXPECT_FALSE(fs::exists(folder.path() / "a.glb"));
}

}  // namespace
}  // namespace gltfx
