// SPDX-License-Identifier: Apache-2.0
/// `gltfx hook` in repositories of git: the files that it checks, and the commits that it stops.
#include <filesystem>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "program/git_support.hpp"
#include "program/upgrade_support.hpp"

namespace gltfx::program {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

class GitHook : public GitRepository {
 protected:
  Outcome hook(const std::string& words, const std::string& where = {}) const {
    return shell("\"$GLTFX\" hook " + words, where);
  }

  const std::string picture_ = picture();
};

TEST_F(GitHook, LooksAtWhatIsStagedAndAtNothingElse) {
  folder_.write("old.gltf", kLegacy);
  commit();
  EXPECT_EQ(hook("upgrade --check").code, 0);
  EXPECT_EQ(hook("upgrade --check").out, "");
  folder_.write("new.gltf", kLegacy);
  EXPECT_EQ(hook("upgrade --check").code, 0);  // not staged
  shell("git add new.gltf");
  const Outcome outcome = hook("upgrade --check");
  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(outcome.out, AllOf(HasSubstr("new.gltf"), Not(HasSubstr("old.gltf"))));
}

TEST_F(GitHook, FixesAndNamesWhatIsToBeStaged) {
  folder_.write("a b/it's.gltf", kLegacy);
  shell("git add -A");
  const Outcome outcome = hook("upgrade --in-place");
  EXPECT_EQ(outcome.code, 1);
  EXPECT_EQ(content("a b/it's.gltf"), kUpgraded);
  EXPECT_THAT(outcome.out, HasSubstr("\n  git add -- 'a b/it'\\''s.gltf'\n"));
  EXPECT_EQ(shell(outcome.out.substr(outcome.out.find("git add"))).code, 0);
  EXPECT_EQ(hook("upgrade --in-place").code, 0);
}

TEST_F(GitHook, APartlyStagedFileIsNotToBeStagedWhole) {
  folder_.write("leaf.gltf", kLegacy);
  shell("git add -A");
  std::string edited = kLegacy;
  edited.replace(edited.find("leaf"), 4, "secret");
  edited.insert(edited.find("  \"materials\""), "  \"images\": [{ \"uri\": \"secret.png\" }],\n");
  folder_.write("leaf.gltf", edited);
  folder_.write("secret.png", picture_);
  for (int run = 0; run < 2; ++run) {  // the second finds nothing to upgrade in the folder
    const Outcome outcome = hook("upgrade --in-place");
    EXPECT_EQ(outcome.code, 1) << outcome.out;
    EXPECT_THAT(outcome.out, AllOf(HasSubstr("'leaf.gltf' is staged with legacy objects"),
                                   HasSubstr("'git add -p'"), Not(HasSubstr("git add --"))));
    EXPECT_THAT(content("leaf.gltf"), HasSubstr("diffuseTransmissionFactor"));
  }
  shell("git add leaf.gltf secret.png");
  EXPECT_EQ(hook("upgrade --in-place").code, 0);
}

TEST_F(GitHook, APartlyStagedFileWithoutLegacyObjectsIsNoHindrance) {
  folder_.write("leaf.gltf", kUpgraded);
  shell("git add -A");
  folder_.write("leaf.gltf", kUpgraded + "\n");
  const Outcome outcome = hook("upgrade --in-place");
  EXPECT_EQ(outcome.code, 0) << outcome.out;
  EXPECT_THAT(outcome.out, Not(HasSubstr("git add")));
}

TEST_F(GitHook, AFileThatIsNotStagedBreaksTheCommitUntilItIs) {
  folder_.write("tree/leaf.gltf", asset_with("maps/new.png"));
  folder_.write("tree/maps/new.png", picture_);
  shell("git add tree/leaf.gltf");
  for (const std::string verb : {"validate", "upgrade --check"}) {
    const Outcome outcome = hook(verb);
    EXPECT_EQ(outcome.code, 1) << verb;
    EXPECT_THAT(outcome.out, HasSubstr("  git add -- tree/maps/new.png\n"));
  }
  EXPECT_THAT(hook("upgrade --check", "tree").out, HasSubstr("  git add -- maps/new.png\n"));
  shell("git add -A");
  EXPECT_EQ(hook("validate").code, 0);
}

TEST_F(GitHook, NamesWithEveryKindOfByteAreTakenAsTheyAre) {
  folder_.write("-o [x]\n\x1b.gltf", kLegacy);
  folder_.write(":(glob)/leaf.gltf", asset_with("%3A%20'%C3%A4.png"));
  folder_.write(":(glob)/: '\xC3\xA4.png", picture_);
  shell("git add -- ./-o* ./:*/*.gltf");
  const Outcome outcome = hook("upgrade --in-place");
  EXPECT_EQ(outcome.code, 1) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("\n  git add -- $'./-o [x]\\012\\033.gltf' "
                                     "'./:(glob)/: '\\''\xC3\xA4.png'\n"));
  EXPECT_THAT(outcome.out, Not(HasSubstr("\x1b")));
  EXPECT_EQ(shell(outcome.out.substr(outcome.out.find("git add"))).code, 0);
  EXPECT_EQ(hook("upgrade --in-place").code, 0);
}

TEST_F(GitHook, AChangedRenamedOrDeletedTextureChecksItsOwners) {
  folder_.write("deep/leaf.gltf", asset_with("../maps/leaf.png"));
  folder_.write("other.gltf", kSound);
  folder_.write("maps/leaf.png", picture_);
  commit();
  folder_.write("maps/leaf.png", "no picture at all");
  shell("git add -A");
  const Outcome changed = hook("validate");
  EXPECT_EQ(changed.code, 1);
  EXPECT_THAT(changed.out, AllOf(HasSubstr("deep/leaf.gltf"), Not(HasSubstr("other.gltf"))));
  shell("git checkout -q HEAD -- maps && git mv maps/leaf.png maps/tree.png");
  const Outcome renamed = hook("upgrade --check");
  EXPECT_EQ(renamed.code, 1);
  EXPECT_THAT(renamed.out,
              HasSubstr("'deep/leaf.gltf' refers to 'maps/leaf.png', which is neither"));
  shell("git reset -q --hard && git rm -q --cached maps/leaf.png");
  const Outcome deleted = hook("upgrade --check");
  EXPECT_EQ(deleted.code, 1);  // still in the folder, but no longer in the repository
  EXPECT_THAT(deleted.out, HasSubstr("git add -- maps/leaf.png"));
}

TEST_F(GitHook, OwnersAreSearchedInTheIndexNotInTheFolder) {
  folder_.write("leaf.gltf", asset_with("leaf.png"));
  folder_.write("leaf.png", picture_);
  commit();
  folder_.write("leaf.gltf", kSound);                   // not staged
  folder_.write("stray.gltf", asset_with("leaf.png"));  // not tracked
  shell("git rm -q --cached leaf.png");
  const Outcome outcome = hook("upgrade --check");
  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(outcome.err, HasSubstr("'leaf.gltf' differs from its staged version"));
  EXPECT_THAT(outcome.out, Not(HasSubstr("stray")));
}

TEST_F(GitHook, BinaryAssetsHaveOwnedFilesToo) {
  std::string glb = read_file(fixture("legacy/lantern.glb"));
  folder_.write("lantern.glb", glb);
  folder_.write("a.bin", "1234");
  commit();
  folder_.write("a.bin", "4321");
  shell("git add -A");
  EXPECT_EQ(hook("upgrade --check").out, "");  // no reference to it
}

TEST_F(GitHook, NamesThatAreGivenCountAsChanged) {
  folder_.write("leaf.gltf", kLegacy);
  folder_.write("maps/leaf.gltf", asset_with("leaf.png"));
  folder_.write("maps/leaf.png", "no picture");
  commit();
  EXPECT_EQ(hook("upgrade --check leaf.gltf").code, 1);
  EXPECT_THAT(hook("validate leaf.png", "maps").out, HasSubstr("leaf.gltf"));
  EXPECT_EQ(hook("validate ../leaf.gltf", "maps").code, 0);
  EXPECT_EQ(hook("validate /").code, 3);
}

TEST_F(GitHook, WhatGitLeavesOutOnPurposeIsOnlyNoted) {
  folder_.write(".gitignore", "*.png\n");
  folder_.write("leaf.gltf", asset_with("leaf.png"));
  folder_.write("leaf.png", picture_);
  shell("git add -A");
  const Outcome outcome = hook("validate");
  EXPECT_EQ(outcome.code, 0);
  EXPECT_THAT(outcome.out, HasSubstr("note: 'leaf.gltf' refers to 'leaf.png', which .gitignore"));
}

TEST_F(GitHook, ANewTextureThatLfsWouldNotKeepIsWarnedOf) {
  folder_.write(".gitattributes", "*.jpg filter=lfs -text\n");
  folder_.write("leaf.gltf", asset_with("leaf.png"));
  folder_.write("leaf.png", picture_);
  folder_.write("old.jpg", kLfsPointer);
  // As with the filter: the index holds the pointer.
  shell("git -c filter.lfs.clean=cat -c filter.lfs.required=false add -A");
  const Outcome outcome = hook("validate");
  EXPECT_EQ(outcome.code, 0);
  EXPECT_THAT(outcome.out, AllOf(HasSubstr("warning: 'leaf.png' would not be kept by Git LFS, as"),
                                 HasSubstr("  git lfs track '*.png'\n")));
  folder_.write(".gitattributes", "*.jpg filter=lfs\n*.png filter=lfs\n");
  shell("git -c filter.lfs.clean=cat -c filter.lfs.required=false add -A");
  EXPECT_THAT(hook("validate").out, Not(HasSubstr("LFS")));
}

TEST_F(GitHook, AssetsThatAreLfsPointersAreReadInTheFolder) {
  folder_.write("leaf.gltf", kLfsPointer);
  shell("git add -A && git commit -qm x");
  folder_.write("leaf.gltf", asset_with("leaf.png"));
  folder_.write("leaf.png", picture_);
  shell("git add leaf.png");
  EXPECT_THAT(hook("validate").out, HasSubstr("1 file checked"));
}

TEST_F(GitHook, FilesInASubmoduleAreItsOwnBusiness) {
  folder_.write("sub/leaf.png", picture_);
  shell(
      "git init -q . && git config user.name a && git config user.email a@example.com && "
      "git add -A && git commit -qm x",
      "sub");
  folder_.write("leaf.gltf", asset_with("sub/leaf.png"));
  const Outcome added = shell("git add leaf.gltf && git add sub 2>/dev/null; git ls-files -s sub");
  ASSERT_THAT(added.out, HasSubstr("160000"));
  EXPECT_EQ(hook("validate").code, 0);
  shell("git commit -qm x");
  shell("git commit -q --allow-empty -m y", "sub");
  shell("git add sub");
  EXPECT_THAT(hook("validate").out, HasSubstr("1 file checked"));  // the submodule's commit changed
}

// Twenty broken assets, each in its own way.
TEST_F(GitHook, FixesTwentyBrokenAssetsAndNamesThem) {
  const std::vector<std::string> broken{
      R"({"asset":{"version":"2.0"},})",
      R"({"asset":{"version":"2.0"},"nodes":[]})",
      R"({"asset":{"version":"2.0"},"extensionsUsed":["KHR_materials_unlit"]})",
      R"({"asset":{"version":"2.0"},"extensionsRequired":["KHR_materials_unlit"]})",
      "\xEF\xBB\xBF{\"asset\":{\"version\":\"2.0\"}}",
  };
  for (std::size_t i = 0; i < 20; ++i) {
    folder_.write("broken " + std::to_string(i) + ".gltf", broken[i % broken.size()]);
  }
  folder_.write("sound.gltf", R"({"asset":{"version":"2.0"}})");
  shell("git add -A");
  const Outcome first = hook("fix --in-place");
  EXPECT_EQ(first.code, 1);
  EXPECT_THAT(first.out, HasSubstr("20 files have to be staged"));
  EXPECT_THAT(first.out, AllOf(HasSubstr("  git add -- 'broken 0.gltf'"), Not(HasSubstr("sound"))));
  const std::size_t line = first.out.find("git add --");
  ASSERT_NE(line, std::string::npos);
  EXPECT_EQ(shell(first.out.substr(line, first.out.find('\n', line) - line)).code, 0);
  EXPECT_EQ(hook("fix --in-place").code, 0);
  EXPECT_EQ(hook("fix --check").code, 0);
  EXPECT_EQ(shell("\"$GLTFX\" validate --fail-on info .").code, 0);
}

TEST_F(GitHook, OutsideOfARepositoryItCannotRun) {
  const Outcome outcome =
      bash("\"$GLTFX\" hook validate", {folder_.path().native(), {}, {{"GIT_DIR", "/nowhere"}}});
  EXPECT_EQ(outcome.code, 3);
  EXPECT_THAT(outcome.err, HasSubstr("no working tree of git"));
  EXPECT_EQ(bash("PATH= \"$GLTFX\" hook validate").code, 3);
}

TEST_F(GitHook, OnlyVerbsThatReadAssetsGoWithIt) {
  for (const std::string words : {"", "rules", "upgrade -o x.gltf", "nonsense"}) {
    EXPECT_EQ(hook(words).code, 2) << words;
  }
  EXPECT_EQ(hook("--help").code, 0);
  EXPECT_THAT(hook("upgrade --help").out, HasSubstr("--in-place"));
}

}  // namespace
}  // namespace gltfx::program
