// SPDX-License-Identifier: Apache-2.0
#include "base/directory.hpp"

#include <cerrno>
#include <filesystem>
#include <fstream>
#include <map>
#include <string>

#include <gtest/gtest.h>
#include <sys/stat.h>

#include "container/temp_folder.hpp"

namespace gltfx {
namespace {

using container::test::TempFolder;

TEST(Directory, EntriesHaveTheirKinds) {
  const TempFolder folder;
  const std::filesystem::path& path = folder.path();
  std::ofstream(path / "file") << "x";
  std::filesystem::create_directory(path / "below");
  std::filesystem::create_symlink("file", path / "link");
  std::filesystem::create_symlink("below", path / "link-below");
  std::filesystem::create_symlink("nothing", path / "dangling");
  ASSERT_EQ(::mkfifo((path / "pipe").c_str(), 0600), 0);
  DirectoryReader directory(path.native());
  std::map<std::string, std::string> kinds;
  while (const char* name = directory.next()) {
    kinds[name] = directory.is_file() ? "file" : directory.is_directory() ? "directory" : "neither";
  }
  EXPECT_FALSE(directory.error());
  EXPECT_EQ(kinds, (std::map<std::string, std::string>{{"file", "file"},
                                                       {"below", "directory"},
                                                       {"link", "file"},
                                                       {"link-below", "neither"},
                                                       {"dangling", "neither"},
                                                       {"pipe", "neither"}}));
}

TEST(Directory, WhatCannotBeOpenedHasAnError) {
  const TempFolder folder;
  DirectoryReader missing((folder.path() / "missing").native());
  EXPECT_EQ(missing.next(), nullptr);
  EXPECT_EQ(missing.error().value(), ENOENT);
  std::ofstream(folder.path() / "file") << "x";
  DirectoryReader file((folder.path() / "file").native());
  EXPECT_EQ(file.next(), nullptr);
  EXPECT_EQ(file.error().value(), ENOTDIR);
}

TEST(Directory, NoPathIsTheWorkingDirectory) {
  DirectoryReader directory("");
  EXPECT_NE(directory.next(), nullptr);
  EXPECT_FALSE(directory.error());
}

}  // namespace
}  // namespace gltfx
