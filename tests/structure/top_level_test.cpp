// SPDX-License-Identifier: Apache-2.0
/// The files at the root of the repository, and tests for every module.
#include <filesystem>
#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "source.hpp"

namespace gltfx::structure {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;
namespace fs = std::filesystem;

const std::set<std::string> kEntries{
    "tools", "libgltfx", "schema", "tests", "fixtures", "docs", "examples", "CMakeLists.txt",
    "CMakePresets.json", "README.md", "HACKING.md", "CHANGELOG.md", "SECURITY.md", "LICENSE",
    ".clang-format", ".clang-tidy", ".gitignore", ".pre-commit-hooks.yaml", ".ci", "Dockerfile",
    ".dockerignore", "action.yml",
    // Not part of the repository: git's own, and what .gitignore names.
    ".git", "build", ".cache", "node_modules", "compile_commands.json"};

Problems check_entries(const std::vector<std::string>& names) {
  Problems problems;
  for (const std::string& name : names) {
    if (kEntries.count(name) == 0 && !name.ends_with(".orig")) problems.push_back(name);
  }
  return problems;
}

std::vector<std::string> names_in(const fs::path& folder, bool folders_only) {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (!folders_only || entry.is_directory()) names.push_back(entry.path().filename().string());
  }
  return names;
}

TEST(TopLevel, OnlyWhatTheDesignAllows) {
  EXPECT_THAT(check_entries(names_in(repository(), false)), IsEmpty());
}

TEST(TopLevel, AnotherEntryIsFound) {
  EXPECT_THAT(check_entries({"libgltfx", "src", "doc"}), ElementsAre("src", "doc"));
}

TEST(TopLevel, EveryRoomHasTests) {
  const fs::path root = repository();
  for (const std::string& module : names_in(root / "libgltfx", true)) {
    if (module == "include") continue;
    const fs::path tests = root / "tests" / module;
    EXPECT_TRUE(fs::is_directory(tests) && !fs::is_empty(tests)) << module;
  }
}

}  // namespace
}  // namespace gltfx::structure
