// SPDX-License-Identifier: Apache-2.0
/// `git diff` and `git log` with gltfx: the driver, the outline, and what sets them up.
#include <filesystem>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "program/git_support.hpp"

namespace gltfx::program {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

// A child node, and a mesh in another order.
const std::string kTwoNodes = R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],
"nodes":[{"name":"Door","children":[1],"camera":0},{"name":"Knob"}],
"cameras":[{"name":"eye","type":"perspective","perspective":{"yfov":1,"znear":0.1}},
{"name":"far","type":"perspective","perspective":{"yfov":2,"znear":0.1}}]})";
const std::string kRenumbered = R"({"asset":{"version":"2.0"},"scenes":[{"nodes":[1]}],"scene":0,
"cameras":[{"name":"far","type":"perspective","perspective":{"yfov":2,"znear":0.1}},
{"name":"eye","type":"perspective","perspective":{"yfov":1.0,"znear":0.1}}],
"nodes":[{"name":"Knob"},{"name":"Door","children":[0],"camera":1}]})";

class GitDriver : public GitRepository {
 protected:
  Outcome setup(const std::string& words = {}) const {
    return shell("gltfx compare --setup-git " + words);
  }
};

TEST_F(GitDriver, SetupWritesWhatIsMissingOnce) {
  folder_.write(".gitattributes", "*.png binary\n*.glb filter=lfs diff=lfs merge=lfs -text");
  const Outcome first = setup();
  EXPECT_EQ(first.code, 0) << first.err;
  const std::string attributes = content(".gitattributes");
  EXPECT_EQ(attributes,
            "*.png binary\n*.glb filter=lfs diff=lfs merge=lfs -text\n*.glb diff=gltfx\n"
            "*.gltf diff=gltfx\n*.vrm diff=gltfx\n");
  EXPECT_THAT(first.out, AllOf(HasSubstr("/.gitattributes:\n  *.glb diff=gltfx\n"),
                               HasSubstr("git config --local diff.gltfx.command 'gltfx compare")));
  EXPECT_EQ(shell("git config diff.gltfx.command").out, "gltfx compare --git-driver\n");
  EXPECT_EQ(shell("git config diff.gltfx.textconv").out, "gltfx inspect --format outline\n");
  EXPECT_EQ(shell("git config diff.gltfx.cachetextconv").out, "true\n");
  EXPECT_THAT(shell("git config difftool.gltfx.cmd").out,
              HasSubstr("\"$MERGED\" \"$LOCAL\" \"$REMOTE\""));
  const Outcome second = setup();
  EXPECT_EQ(second.code, 0);
  EXPECT_EQ(second.out, "nothing to do: git is set up\n");
  EXPECT_EQ(content(".gitattributes"), attributes);
}

TEST_F(GitDriver, SetupKeepsOtherValuesAndNamesThem) {
  folder_.write(".gitattributes", "*.glb -diff\n*.gl* diff=other\n");
  shell("git config diff.gltfx.command mine");
  const Outcome outcome = setup();
  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(outcome.err, AllOf(HasSubstr("diff=other for *.gltf, which stays"),
                                 HasSubstr("diff.gltfx.command is mine, which stays")));
  EXPECT_EQ(content(".gitattributes"), "*.glb -diff\n*.gl* diff=other\n*.vrm diff=gltfx\n");
  EXPECT_EQ(shell("git config diff.gltfx.command").out, "mine\n");
  EXPECT_EQ(shell("git config diff.gltfx.cachetextconv").out, "true\n");
}

TEST_F(GitDriver, SetupOfTheUserDoesNotTouchTheRepository) {
  EXPECT_EQ(setup("--global").code, 0);
  EXPECT_EQ(content(".config/git/attributes"),
            "*.glb diff=gltfx\n*.gltf diff=gltfx\n*.vrm diff=gltfx\n");
  EXPECT_FALSE(std::filesystem::exists(folder_.path() / ".gitattributes"));
  EXPECT_EQ(shell("git config --local diff.gltfx.command").code, 1);
  EXPECT_EQ(shell("git config --global diff.gltfx.command").code, 0);
  shell("git config --global core.attributesFile '~/own attributes'");
  EXPECT_EQ(setup("--global").code, 0);
  EXPECT_THAT(content("own attributes"), HasSubstr("*.vrm diff=gltfx\n"));
}

TEST_F(GitDriver, SetupNeedsAWorkingTreeAndNoPaths) {
  EXPECT_EQ(setup("a.glb").code, 2);
  EXPECT_EQ(shell("gltfx compare a.glb b.glb --global").code, 2);
  EXPECT_EQ(shell("GIT_DIR=/nowhere gltfx compare --setup-git").code, 2);
}

TEST_F(GitDriver, GitDiffSaysWhatChanged) {
  setup();
  folder_.write("a b.gltf", node_at(0, "Door"));
  folder_.write("gone.gltf", node_at(0, "Gone"));
  commit();
  folder_.write("a b.gltf", node_at(1, "Door"));
  shell("git rm -q gone.gltf");
  folder_.write("new.gltf", asset_with("new.png"));
  folder_.write("broken.gltf", "no asset");
  shell("git add -N new.gltf broken.gltf");
  const Outcome outcome = shell("git diff HEAD");
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_THAT(outcome.out,
              AllOf(HasSubstr("a/a b.gltf -> b/a b.gltf: differs: 1 node.moved\n"),
                    HasSubstr("a/gone.gltf: removed\n"), HasSubstr("b/new.gltf: added\n")));
  shell("git mv -- 'a b.gltf' -c.gltf && git add -A && chmod +x ./-c.gltf");
  const Outcome renamed = shell("git diff -M10% HEAD");
  EXPECT_EQ(renamed.code, 0) << renamed.err;
  EXPECT_THAT(renamed.out, AllOf(HasSubstr("a/a b.gltf -> b/-c.gltf: differs: 1 node.moved"),
                                 HasSubstr("  mode 100644 -> 100755\n")));
}

TEST_F(GitDriver, WhatCannotBeComparedDoesNotStopGit) {
  setup();
  folder_.write("a.gltf", "no asset");
  commit();
  folder_.write("a.gltf", "still none");
  const Outcome outcome = shell("git diff");
  EXPECT_EQ(outcome.code, 0);
  EXPECT_THAT(outcome.out, HasSubstr("not compared: "));
  shell("rm a.gltf && ln -s somewhere a.gltf");
  EXPECT_EQ(shell("git diff").code, 0);
}

TEST_F(GitDriver, FilesBesideAnAssetAreThoseOfItsCommit) {
  setup();
  folder_.write("deep/leaf.gltf", asset_with("../maps/leaf.png"));
  folder_.write("maps/leaf.png", picture());
  commit();
  folder_.write("deep/leaf.gltf", asset_with("../maps/leaf.png") + "\n");
  EXPECT_THAT(shell("git diff").out, AllOf(HasSubstr("deep/leaf.gltf: storage"),
                                           Not(HasSubstr("unproven")), Not(HasSubstr("note:"))));
  folder_.write("maps/leaf.png", other_picture());
  EXPECT_THAT(shell("git diff -- ../deep", "maps").out, HasSubstr("image.texels"));
  EXPECT_THAT(shell("git diff", "deep").out, HasSubstr("image.texels"));
  commit();
  EXPECT_THAT(shell("git diff HEAD~1 HEAD -- deep").out, HasSubstr("image.texels"));
  folder_.write("deep/leaf.gltf", node_at(0, "Door"));
  commit();
  const Outcome older = shell("git diff HEAD~2 HEAD~1 -- deep");
  EXPECT_THAT(older.out, AllOf(HasSubstr("image.texels"), Not(HasSubstr("note:"))));
}

// In a browser, with the files beside both versions.
TEST_F(GitDriver, TheDifftoolOpensAPage) {
  setup();
  shell("git config web.browser copy && git config browser.copy.cmd 'cp -t \"$HOME\"'");
  folder_.write("deep/leaf.gltf", asset_with("../maps/leaf.png"));
  folder_.write("maps/leaf.png", picture());
  commit();
  folder_.write("deep/leaf.gltf", asset_with("../maps/leaf.png") + "\n");
  const std::string run = "TMPDIR=\"$HOME\" git difftool -y -t gltfx";
  const Outcome outcome = shell(run);
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("/compare.html\n"));
  EXPECT_THAT(content("compare.html"),
              AllOf(HasSubstr("leaf.gltf"), HasSubstr("\"storage\""),
                    Not(HasSubstr("cannot be read")), Not(HasSubstr("\"error\""))));
  shell("rm compare.html && git rm -qf deep/leaf.gltf");
  EXPECT_EQ(shell(run + " HEAD").code, 0);
  EXPECT_THAT(content("compare.html"), HasSubstr("leaf.gltf"));
  folder_.write("maps/leaf.png", other_picture());
  EXPECT_THAT(shell(run).err, HasSubstr("maps/leaf.png is no asset"));
}

TEST_F(GitDriver, TheLogShowsOutlines) {
  setup();
  folder_.write("a.gltf", kTwoNodes);
  commit();
  folder_.write("a.gltf", kRenumbered);
  commit();
  std::string moved = kRenumbered;
  moved.replace(moved.find("\"Knob\""), 6, "\"Knob\",\"translation\":[1,0,0]");
  folder_.write("a.gltf", moved);
  commit();
  const Outcome last = shell("git log -p -1 --format=");
  EXPECT_EQ(last.code, 0) << last.err;
  EXPECT_THAT(last.out, AllOf(HasSubstr("\n-node 'Door'/'Knob'  "),
                              HasSubstr("\n+node 'Door'/'Knob'  "), Not(HasSubstr("\n-camera"))));
  const Outcome renumbered = shell("git show --format= HEAD~1");
  EXPECT_THAT(renumbered.out, Not(HasSubstr("\n+node")));
}

TEST_F(GitDriver, OutlinesAreSortedLinesAndTheSameInEachRun) {
  folder_.write("a.gltf", kTwoNodes);
  folder_.write("-b.gltf", kRenumbered);
  const Outcome one = shell("gltfx inspect --format outline a.gltf");
  EXPECT_EQ(one.code, 0);
  EXPECT_THAT(one.out, AllOf(StartsWith("asset  glTF 2.0  "), HasSubstr("\ncamera 'far'  "),
                             HasSubstr("\nnode 'Door'  camera 'eye', 1 child  "),
                             HasSubstr("\nscene *  1 root node  ")));
  EXPECT_EQ(shell("gltfx inspect --format outline -b.gltf").out, one.out);
  EXPECT_EQ(shell("gltfx inspect --format outline a.gltf | LC_ALL=C sort -c").code, 0);
  EXPECT_EQ(shell("gltfx inspect --format outline '" + fixture("good/bowl.glb") + "'").out,
            shell("gltfx inspect --format outline '" + fixture("good/bowl.glb") + "'").out);
}

TEST_F(GitDriver, AnOutlineOfListsOfNumbersHasLines) {
  for (const std::string list : {"nodes", "meshes", "images", "materials", "textures", "scenes",
                                 "skins", "animations", "cameras", "accessors", "buffers"}) {
    folder_.write("a.gltf", R"({"asset": {"version": "2.0"}, ")" + list + R"(": [5, 0, 1]})");
    const Outcome outcome = shell("gltfx inspect --format outline a.gltf");
    EXPECT_EQ(outcome.code, 0) << list;
    EXPECT_THAT(outcome.out, HasSubstr("asset  glTF 2.0  ")) << list;
  }
}

TEST_F(GitDriver, AnOutlineNamesFilesInPlaceOfReadingThem) {
  folder_.write("leaf.gltf", asset_with("leaf.png"));
  const std::string without = shell("gltfx inspect --format outline leaf.gltf").out;
  folder_.write("leaf.png", picture());
  EXPECT_EQ(shell("gltfx inspect --format outline leaf.gltf").out, without);
  EXPECT_THAT(without, HasSubstr("\nimage *  in 'leaf.png'  "));
  folder_.write("broken.glb", kLfsPointer);
  const Outcome broken = shell("gltfx inspect --format outline broken.glb");
  EXPECT_EQ(broken.code, 0);
  EXPECT_THAT(broken.out, StartsWith("no outline: it is a Git LFS pointer"));
}

}  // namespace
}  // namespace gltfx::program
