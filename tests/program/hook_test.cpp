// SPDX-License-Identifier: Apache-2.0
/// The hooks for pre-commit, as a repository with assets would use it.
#include <filesystem>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "container/temp_folder.hpp"
#include "process.hpp"

namespace gltfx::program {
namespace {

using container::test::TempFolder;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

// Two repositories below one folder: `hooks` offers the hook, `assets` uses it.
class Hook : public testing::Test {
 protected:
  void SetUp() override {
    if (bash("command -v pre-commit && command -v git").code != 0) {
      GTEST_SKIP() << "pre-commit or git is not installed";
    }
    folder_.write("hooks/.pre-commit-hooks.yaml",
                  read_file(GLTFX_SOURCE_DIR "/.pre-commit-hooks.yaml"));
    commit("hooks");
    folder_.write("assets/sound.gltf", kSound);
    folder_.write("assets/notes.txt", "not an asset");
  }
  void commit(const std::string& name) const {
    const Outcome outcome = shell(
        "git init -q . && git add -A && git -c user.name=a -c user.email=a@example.com "
        "commit -q -m start",
        name);
    ASSERT_EQ(outcome.code, 0) << outcome.err;
  }
  Outcome try_hook(const std::string& hook = "gltfx-validate") const {
    shell("git init -q . && git add -A", "assets");
    return shell("pre-commit try-repo ../hooks " + hook + " --all-files --color never", "assets");
  }
  Outcome shell(const std::string& line, const std::string& where) const {
    const std::string bin = std::filesystem::path(program()).parent_path().native();
    return bash("export PATH=\"$BIN:$PATH\" && " + line,
                {(folder_.path() / where).native(),
                 {},
                 {{"BIN", bin},
                  {"PRE_COMMIT_HOME", (folder_.path() / "cache").native()},
                  {"HOME", folder_.path().native()}}});
  }

  TempFolder folder_;
};

TEST_F(Hook, PassesWhereAllAssetsAreSound) {
  const Outcome outcome = try_hook();
  EXPECT_EQ(outcome.code, 0) << outcome.out << outcome.err;
  EXPECT_THAT(outcome.out, AllOf(HasSubstr("Validate glTF assets"), HasSubstr("Passed")));
}

TEST_F(Hook, FailsWithTheReportWhereOneIsNot) {
  folder_.write("assets/deep/Faulty.GLTF", kFaulty);
  const Outcome outcome = try_hook();
  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(outcome.out, AllOf(HasSubstr("Failed"), HasSubstr("error[VALUE_NOT_IN_RANGE]"),
                                 HasSubstr("deep/Faulty.GLTF:2:26"), Not(HasSubstr("notes.txt"))));
}

TEST_F(Hook, ThatUpgradesFailsOnceAndPassesThen) {
  const std::string old = read_file(fixture("legacy/lantern.glb"));
  folder_.write("assets/lantern.glb", old);
  EXPECT_EQ(try_hook("gltfx-upgrade-check").code, 1);
  EXPECT_EQ(read_file((folder_.path() / "assets/lantern.glb").native()), old);
  EXPECT_EQ(try_hook("gltfx-upgrade").code, 1);  // pre-commit stops a commit that a hook changed
  EXPECT_EQ(read_file((folder_.path() / "assets/lantern.glb").native()),
            read_file(fixture("legacy/upgraded/lantern.glb")));
  EXPECT_EQ(try_hook("gltfx-upgrade").code, 0);
  EXPECT_EQ(try_hook("gltfx-upgrade-check").code, 0);
}

TEST_F(Hook, ACommitThatOnlyDeletesATextureIsNotSkipped) {
  folder_.write("assets/leaf.gltf", R"({"asset":{"version":"2.0"},"images":[{"uri":"leaf.png"}]})");
  folder_.write("assets/leaf.png", read_file(fixture("good/leaf_color.png")));
  commit("assets");
  shell("git rm -q leaf.png", "assets");
  const Outcome outcome =
      shell("pre-commit try-repo ../hooks gltfx-validate --color never", "assets");
  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(outcome.out, HasSubstr("'leaf.gltf' refers to 'leaf.png'"));
}

TEST_F(Hook, ThatUpgradesFailsWhileSomethingIsLeft) {
  folder_.write("assets/shop.gltf", R"({"asset": {"version": "2.0"},
 "extensionsUsed": ["KHR_materials_translucency"], "images": [{"uri": "missing.png"}],
 "textures": [{"source": 0}],
 "materials": [{"extensions": {"KHR_materials_translucency": {"translucencyFactor": 0.5,
                                                              "translucencyTexture": {"index": 0}}}}]})");
  const Outcome outcome = try_hook("gltfx-upgrade");
  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(outcome.out, HasSubstr("left alone"));
}

}  // namespace
}  // namespace gltfx::program
