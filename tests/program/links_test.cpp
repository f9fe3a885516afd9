// SPDX-License-Identifier: Apache-2.0
/// Folders with symbolic links that lead elsewhere: nothing there is read or written.
#include <filesystem>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "container/temp_folder.hpp"
#include "process.hpp"

namespace gltfx::program {
namespace {

namespace fs = std::filesystem;
using container::test::TempFolder;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

// Findings, fixes, upgrades and pictures would show its text.
const std::string kOutside = R"({"asset": {"version": "2.0", "generator": "SECRET", "SECRET": 1},
"extensionsUsed": ["KHR_materials_translucency", "SECRET_a", "SECRET_a"],
"materials": [{"name": "SECRET", "extensions":
{"KHR_materials_translucency": {"translucencyFactor": 1, "SECRET": 2}}}]})";

class Links : public testing::Test {
 protected:
  Links() {
    folder_.write("outside/model.gltf", kOutside);
    folder_.write("outside/config.json", R"({"password": "SECRET"})");
    fs::create_directories(folder_.path() / "in/sub");
    link("../outside/model.gltf", "in/a.gltf");
    link("../outside/config.json", "in/b.gltf");
    link("../../outside/model.gltf", "in/sub/c.gltf");
    link((folder_.path() / "outside/model.gltf").native(), "in/d.gltf");
  }
  void link(const std::string& to, const std::string& from) const {
    fs::create_symlink(to, folder_.path() / from);
  }
  std::string content(const std::string& name) const {
    return read_file((folder_.path() / name).native());
  }
  Outcome here(std::vector<std::string> words) const { return gltfx(std::move(words), setting_); }
  void expect_nothing_of_outside(const std::vector<std::string>& words) const {
    const Outcome outcome = here(words);
    EXPECT_EQ(outcome.code, 3) << words.front() << outcome.out << outcome.err;
    EXPECT_THAT(outcome.out + outcome.err,
                AllOf(Not(HasSubstr("SECRET")), HasSubstr("is outside the folder")));
    EXPECT_EQ(content("outside/model.gltf"), kOutside);
  }

  TempFolder folder_;
  Setting setting_{folder_.path().native(), {}, {}};
};

TEST_F(Links, ThatLeaveAFolderAreNotFollowedByAnyVerb) {
  expect_nothing_of_outside({"validate", "in"});
  expect_nothing_of_outside({"validate", "in/"});
  expect_nothing_of_outside({"validate", "in/*.gltf"});
  expect_nothing_of_outside({"validate", "in", "--format", "json"});
  expect_nothing_of_outside({"inspect", "in"});
  expect_nothing_of_outside({"fix", "in", "--in-place"});
  expect_nothing_of_outside({"fix", "in", "-o", "out"});
  expect_nothing_of_outside({"upgrade", "in", "--in-place"});
  expect_nothing_of_outside({"upgrade", "in", "--diff"});
  expect_nothing_of_outside({"edit", "in", "--delete", "/materials/0", "--in-place"});
  expect_nothing_of_outside({"report", "in", "--no-thumbnails", "-o", "-"});
  EXPECT_FALSE(fs::exists(folder_.path() / "out/a.gltf"));
}

TEST_F(Links, ThatLeaveTheWorkingFolderAreNotFollowedByAPattern) {
  const Setting inside{(folder_.path() / "in").native(), {}, {}};
  for (const char* pattern : {"*.gltf", "**/*.gltf", "*/*.gltf"}) {
    const Outcome outcome = gltfx({"validate", pattern}, inside);
    EXPECT_EQ(outcome.code, 3) << pattern;
    EXPECT_THAT(outcome.out,
                AllOf(Not(HasSubstr("SECRET")), HasSubstr("outside the working folder")));
  }
}

TEST_F(Links, ThatLeaveAFolderAreNotDrawn) {
  const Outcome outcome = here({"bake", "in", "-o", "out", "--embed"});
  if (outcome.code == 2) GTEST_SKIP() << outcome.err;
  expect_nothing_of_outside({"bake", "in", "-o", "out"});
  expect_nothing_of_outside({"bake", "in", "--embed"});
}

TEST_F(Links, ThatLeaveAFolderAreNotRestored) {
  folder_.write("in/a.gltf.bak", "forged");
  expect_nothing_of_outside({"fix", "in", "--restore"});
  EXPECT_TRUE(fs::exists(folder_.path() / "in/a.gltf.bak"));
}

TEST_F(Links, OfCompanionsThatLeaveAFolderAreNotRestored) {
  folder_.write("outside/a.bin", "kept");
  folder_.write("own/a.bin.bak", "forged");
  folder_.write("own/a.gltf", kSound);
  folder_.write("own/a.gltf.bak", R"({"asset": {"version": "2.0"},
"buffers": [{"uri": "a.bin", "byteLength": 4}]})");
  link("../outside/a.bin", "own/a.bin");
  EXPECT_EQ(here({"fix", "own", "--restore"}).code, 0);
  EXPECT_EQ(content("outside/a.bin"), "kept");
}

TEST_F(Links, WithinAFolderAreFollowed) {
  folder_.write("own/sub/model.gltf", kFaulty);
  link("sub/model.gltf", "own/link.gltf");
  EXPECT_THAT(here({"validate", "own"}).out, HasSubstr("own/link.gltf"));
  EXPECT_EQ(here({"validate", "own"}).code, 1);
}

TEST_F(Links, ThatAreNamedAreFollowed) {
  EXPECT_THAT(here({"validate", "in/a.gltf"}).out, HasSubstr("SECRET"));
  EXPECT_THAT(here({"validate", "in/../in/a.gltf", "in/sub"}).out, HasSubstr("SECRET"));
  EXPECT_EQ(here({"fix", "in/a.gltf", "--in-place"}).code, 0);
  EXPECT_NE(content("outside/model.gltf"), kOutside);
}

TEST_F(Links, AWiderRootPermitsWhatLiesInIt) {
  EXPECT_THAT(here({"validate", "in", "--root", "."}).out, HasSubstr("SECRET"));
}

TEST_F(Links, TheRootHoldsForAssetsThatAreNamed) {
  expect_nothing_of_outside({"validate", "--root", "in", "in/a.gltf"});
  expect_nothing_of_outside({"validate", "--root", "in", "outside/model.gltf"});
  expect_nothing_of_outside({"fix", "--root", "in", "outside/model.gltf", "--in-place"});
  expect_nothing_of_outside({"inspect", "--root", "in", "in/../outside/model.gltf"});
  folder_.write("in/own.gltf", kSound);
  EXPECT_EQ(here({"validate", "--root", "in", "in/own.gltf"}).code, 0);
}

TEST_F(Links, AFolderThatIsALinkIsNotEnteredUnlessNamed) {
  folder_.write("other/a.gltf", kFaulty);
  fs::create_directories(folder_.path() / "linking");
  link("../other", "linking/way");
  EXPECT_EQ(here({"validate", "linking", "--allow-empty"}).code, 0);
  EXPECT_EQ(here({"validate", "linking/*", "--allow-empty"}).code, 0);
  EXPECT_EQ(here({"validate", "linking/way"}).code, 1);
}

// A report of the file when it was named is in the cache.
TEST_F(Links, AreNotAnsweredFromTheCache) {
  TempFolder::wait_for_tick();
  EXPECT_THAT(here({"validate", "in/a.gltf", "--cache", "kept"}).out, HasSubstr("SECRET"));
  EXPECT_THAT(here({"validate", "in/a.gltf", "--cache", "kept"}).out, HasSubstr("SECRET"));
  expect_nothing_of_outside({"validate", "in", "--cache", "kept"});
}

}  // namespace
}  // namespace gltfx::program
