// SPDX-License-Identifier: Apache-2.0
/// Repositories of git with small assets.
#pragma once

#include <filesystem>
#include <string>

#include <gtest/gtest.h>

#include "container/temp_folder.hpp"
#include "program/process.hpp"

namespace gltfx::program {

/// An asset with one image.
inline std::string asset_with(const std::string& uri) {
  return R"({"asset":{"version":"2.0"},"images":[{"uri":")" + uri + R"("}],)" +
         R"("textures":[{"source":0}],"materials":[{"emissiveTexture":{"index":0}}]})";
}

/// An asset with one node.
inline std::string node_at(int x, const std::string& name) {
  return R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"name":")" +
         name + R"(","translation":[)" + std::to_string(x) + ",0,0]}]}";
}

inline const std::string kLfsPointer =
    "version https://git-lfs.github.com/spec/v1\noid sha256:" + std::string(64, 'a') +
    "\nsize 12345\n";

/// A repository in a folder of its own, which is the home of its user as well.
class GitRepository : public testing::Test {
 protected:
  void SetUp() override {
    if (bash("command -v git").code != 0) GTEST_SKIP() << "git is not installed";
    shell("git init -q . && git config user.name a && git config user.email a@example.com");
  }
  /// Runs a line of bash. `gltfx` is on the PATH.
  Outcome shell(const std::string& line, const std::string& where = {}) const {
    return bash("PATH=\"$(dirname \"$GLTFX\"):$PATH\"\n" + line,
                {(folder_.path() / where).native(),
                 {},
                 {{"HOME", folder_.path().native()},
                  {"XDG_CONFIG_HOME", {}},
                  {"GIT_CONFIG_NOSYSTEM", "1"}}});
  }
  /// Commits all files, then runs a line.
  void commit(const std::string& then = "true") const {
    const Outcome outcome = shell("git add -A && git commit -qm x && " + then);
    ASSERT_EQ(outcome.code, 0) << outcome.err;
  }
  std::string content(const std::string& name) const {
    return read_file((folder_.path() / name).native());
  }
  static std::string picture() { return read_file(fixture("good/leaf_color.png")); }
  static std::string other_picture() { return read_file(fixture("good/stone_orm.png")); }

  container::test::TempFolder folder_;
};

}  // namespace gltfx::program
