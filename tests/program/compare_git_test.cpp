// SPDX-License-Identifier: Apache-2.0
/// `gltfx compare --git`: assets of commits and of the working tree.
#include <filesystem>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "program/git_support.hpp"

namespace gltfx::program {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

class CompareGit : public GitRepository {
 protected:
  Outcome compare(const std::string& words, const std::string& where = {}) const {
    return shell("\"$GLTFX\" compare --git " + words, where);
  }
  // "old -> new level" of each pair.
  std::vector<std::string> pairs(const std::string& words, const std::string& where = {}) const {
    const Outcome outcome = shell("\"$GLTFX\" compare --format json --git " + words, where);
    const nlohmann::json report = nlohmann::json::parse(outcome.out, nullptr, false);
    std::vector<std::string> all;
    if (report.is_discarded()) return {outcome.err};
    for (const nlohmann::json& pair : report["pairs"]) {
      const auto name = [&pair](const char* side) {
        return pair[side].is_null() ? std::string("-") : pair[side].get<std::string>();
      };
      all.push_back(name("old") + " -> " + name("new") + " " + pair["level"].get<std::string>());
    }
    return all;
  }
};

TEST_F(CompareGit, PairsWhatChangedAndWhatWasRenamed) {
  for (const char* name : {"a.gltf", "b.gltf", "c.gltf", "same.gltf"}) {
    folder_.write(name, node_at(0, name));
  }
  commit();
  folder_.write("a.gltf", node_at(1, "a.gltf"));
  shell("mkdir sub && git mv b.gltf 'sub/new b.gltf' && git rm -q c.gltf");
  folder_.write("d.gltf", asset_with("another.png"));
  folder_.write("stray.gltf", node_at(0, "stray"));
  shell("git add d.gltf");
  const auto expected = ElementsAre("a.gltf -> a.gltf differs", "c.gltf -> - differs",
                                    "- -> d.gltf differs", "b.gltf -> sub/new b.gltf identical");
  EXPECT_THAT(pairs("HEAD"), expected);
  const Outcome text = compare("HEAD");
  EXPECT_EQ(text.code, 1);
  EXPECT_THAT(text.out, AllOf(HasSubstr("a.gltf: differs: 1 node.moved"),
                              HasSubstr("c.gltf: removed"), HasSubstr("d.gltf: added"),
                              HasSubstr("4 pairs: 1 identical"), Not(HasSubstr("stray"))));
  EXPECT_EQ(compare("HEAD --allow differs").code, 0);
  EXPECT_EQ(shell("git rm -q --cached stray.gltf; git commit -qm y && git tag two").code, 0);
}

TEST_F(CompareGit, ReadsBothSidesOfARangeFromTheirCommits) {
  folder_.write("a.gltf", node_at(0, "Door"));
  commit("git tag one");
  folder_.write("a.gltf", node_at(1, "Door"));
  commit("git tag two");
  folder_.write("a.gltf", "not an asset");
  EXPECT_THAT(pairs("one..two"), ElementsAre("a.gltf -> a.gltf differs"));
  EXPECT_THAT(pairs("one..one"), IsEmpty());
  EXPECT_THAT(pairs("two..one"), ElementsAre("a.gltf -> a.gltf differs"));
  EXPECT_EQ(compare("HEAD").code, 3);
  shell("git checkout -qf -b side one");
  folder_.write("side.gltf", node_at(0, "Side"));
  commit();
  EXPECT_THAT(pairs("two..side"),
              ElementsAre("a.gltf -> a.gltf differs", "- -> side.gltf differs"));
  EXPECT_THAT(pairs("two...side"), ElementsAre("- -> side.gltf differs"));
  EXPECT_THAT(pairs("two..."), ElementsAre("- -> side.gltf differs"));
}

TEST_F(CompareGit, WithoutAChangeNothingDiffers) {
  folder_.write("a.gltf", node_at(0, "Door"));
  commit();
  shell("touch a.gltf");
  const Outcome outcome = compare("HEAD");
  EXPECT_EQ(outcome.code, 0);
  EXPECT_EQ(outcome.out, "No asset changed.\n");
}

TEST_F(CompareGit, ATextureLeadsToTheAssetsThatUseIt) {
  folder_.write("deep/leaf.gltf", asset_with("../maps/leaf.png"));
  folder_.write("other.gltf", node_at(0, "other"));
  folder_.write("maps/leaf.png", picture());
  commit("git tag one");
  folder_.write("maps/leaf.png", other_picture());
  EXPECT_THAT(pairs("HEAD"), ElementsAre("deep/leaf.gltf -> deep/leaf.gltf differs"));
  EXPECT_THAT(compare("HEAD").out, HasSubstr("image.texels"));
  commit();
  shell("git rm -q -r .");
  EXPECT_THAT(pairs("one..HEAD"), ElementsAre("deep/leaf.gltf -> deep/leaf.gltf differs"));
  EXPECT_THAT(compare("one..HEAD").out, HasSubstr("image.texels"));
  EXPECT_THAT(pairs("one..HEAD maps/ other.gltf"), IsEmpty());
  EXPECT_THAT(pairs("one..HEAD -- deep"), ElementsAre(HasSubstr("deep/leaf.gltf")));
}

TEST_F(CompareGit, NamesAreThoseOfTheWorkingFolder) {
  folder_.write("props/a.gltf", node_at(0, "Door"));
  folder_.write("top.gltf", node_at(0, "Door"));
  commit();
  folder_.write("props/a.gltf", node_at(1, "Door"));
  folder_.write("top.gltf", node_at(1, "Door"));
  EXPECT_THAT(pairs("HEAD", "props"),
              ElementsAre("a.gltf -> a.gltf differs", "../top.gltf -> ../top.gltf differs"));
  EXPECT_THAT(pairs("HEAD .", "props"), ElementsAre("a.gltf -> a.gltf differs"));
  EXPECT_THAT(pairs("HEAD ..", "props").size(), 2U);
  EXPECT_EQ(compare("HEAD ../..", "props").code, 2);
}

TEST_F(CompareGit, NamesHaveAnyBytes) {
  const std::vector<std::string> names{"-o a.gltf", "line\nbreak.gltf", "tab\t\"quote\".gltf",
                                       "bad\xFF.gltf", ":(top)x.gltf"};
  for (const std::string& name : names) folder_.write(name, asset_with("-%20%0A%FF.png"));
  commit("git tag one");
  for (const std::string& name : names) folder_.write(name, node_at(0, "x"));
  commit();
  const Outcome outcome = compare("one..HEAD");
  EXPECT_EQ(outcome.code, 1);
  EXPECT_EQ(outcome.err, "");
  EXPECT_THAT(outcome.out, AllOf(HasSubstr("5 pairs: 0 identical"), Not(HasSubstr("\xFF"))));
}

TEST_F(CompareGit, LinksAreFollowedInsideTheCommitOnly) {
  folder_.write("maps/leaf.png", picture());
  folder_.write("in.gltf", asset_with("tex/leaf.png"));
  folder_.write("out.gltf", asset_with("out.png"));
  const std::string outside = fixture("good/leaf_color.png");
  shell("ln -s maps tex && ln -s loop loop.png && ln -s '" + outside +
        "' out.png && "
        "ln -s ../../../../../../../../../../etc/passwd up.png");
  commit("git tag one");
  folder_.write("maps/leaf.png", other_picture());
  folder_.write("out.gltf", asset_with("out.png") + "\n");
  commit();
  const Outcome outcome = compare("one..HEAD --format json");
  const nlohmann::json report = nlohmann::json::parse(outcome.out);
  ASSERT_EQ(report["pairs"].size(), 2U) << outcome.out;
  EXPECT_EQ(report["pairs"][0]["level"], "differs");
  EXPECT_EQ(report["pairs"][0]["changes"][0]["kind"], "image.texels");
  EXPECT_EQ(report["pairs"][1]["level"], "storage") << outcome.out;  // missing on both sides
  // In the working tree, too.
  folder_.write("out.gltf", asset_with("out.png") + "\n\n");
  EXPECT_THAT(pairs("HEAD"), ElementsAre("out.gltf -> out.gltf storage"));
}

TEST_F(CompareGit, LfsPointersAreReplacedByTheirFilesOrNamed) {
  folder_.write(".gitattributes", "*.gltf filter=lfs\n*.png filter=lfs\n");
  folder_.write("a.gltf", kLfsPointer);
  folder_.write("leaf.gltf.real", asset_with("leaf.png"));
  commit("git tag one");
  folder_.write("a.gltf", node_at(0, "Door"));
  const std::string clean = "git -c filter.lfs.clean=cat ";
  shell(clean + "add -A && " + clean + "commit -qm x");
  const Outcome named = compare("one..HEAD");
  EXPECT_EQ(named.code, 3);
  EXPECT_THAT(named.err, AllOf(HasSubstr("a.gltf: it is a Git LFS pointer"), HasSubstr("fetch")));
  // Whatever the filter makes of the pointer counts.
  folder_.write("door.txt", node_at(1, "Door"));
  shell("git config filter.lfs.smudge 'grep -q git-lfs && cat door.txt || cat a.gltf'");
  EXPECT_THAT(pairs("one..HEAD"), ElementsAre("a.gltf -> a.gltf differs"));
  EXPECT_THAT(compare("one..HEAD").out, HasSubstr("1 node.moved"));
}

TEST_F(CompareGit, ATextureThatIsAnLfsPointerIsNamed) {
  folder_.write("leaf.gltf", asset_with("leaf.png"));
  folder_.write("leaf.png", kLfsPointer);
  commit("git tag one");
  folder_.write("leaf.png", picture());
  commit();
  const Outcome outcome = compare("one..HEAD");
  EXPECT_EQ(outcome.code, 3);
  EXPECT_THAT(outcome.err, HasSubstr("leaf.png at one: it is a Git LFS pointer"));
  EXPECT_THAT(outcome.out, HasSubstr("leaf.gltf"));
}

TEST_F(CompareGit, FilesOfASubmoduleAreNotRead) {
  folder_.write("sub/leaf.png", picture());
  shell("git init -q . && git add -A && git -c user.name=a -c user.email=a@b.c commit -qm x",
        "sub");
  folder_.write("leaf.gltf", asset_with("sub/leaf.png"));
  commit("git tag one");
  shell("git -c user.name=a -c user.email=a@b.c commit -q --allow-empty -m y", "sub");
  commit();
  EXPECT_THAT(pairs("one..HEAD"), ElementsAre("leaf.gltf -> leaf.gltf identical"));
}

TEST_F(CompareGit, MistakesAreThoseOfTheUser) {
  folder_.write("a.gltf", node_at(0, "Door"));
  commit();
  const Outcome unknown = compare("nowhere");
  EXPECT_EQ(unknown.code, 2);
  EXPECT_THAT(unknown.err, AllOf(HasSubstr("fatal:"), HasSubstr("no commit 'nowhere'")));
  EXPECT_EQ(compare("--output=x").code, 2);
  EXPECT_EQ(compare("HEAD..nowhere").code, 2);
  EXPECT_EQ(compare("HEAD:a.gltf").code, 2);
  EXPECT_EQ(compare("HEAD /").code, 2);
  EXPECT_EQ(compare("HEAD --root .").code, 2);
  EXPECT_EQ(compare("HEAD --git-driver").code, 2);
  const Outcome outside = bash("\"$GLTFX\" compare --git HEAD",
                               {folder_.path().native(), {}, {{"GIT_DIR", "/nowhere"}}});
  EXPECT_EQ(outside.code, 2);
  EXPECT_THAT(outside.err, HasSubstr("fatal: not a git repository"));
}

TEST_F(CompareGit, ShallowAndBareRepositoriesHaveWhatTheyHave) {
  folder_.write("work/a.gltf", node_at(0, "Door"));
  shell(
      "git init -q . && git config user.name a && git config user.email a@b.c && git add -A && "
      "git commit -qm x && git tag one",
      "work");
  folder_.write("work/a.gltf", node_at(1, "Door"));
  shell("git commit -qam y", "work");
  ASSERT_EQ(shell("git clone -q --depth 1 \"file://$PWD/work\" shallow && "
                  "git clone -q --bare work bare.git")
                .code,
            0);
  EXPECT_EQ(compare("HEAD", "shallow").code, 0);
  EXPECT_EQ(compare("HEAD~1", "shallow").code, 2);
  EXPECT_THAT(pairs("one..HEAD", "bare.git"), ElementsAre("a.gltf -> a.gltf differs"));
  EXPECT_EQ(compare("HEAD", "bare.git").code, 2);
}

TEST_F(CompareGit, MarkdownListsAllPairs) {
  folder_.write("a.gltf", node_at(0, "Door"));
  commit();
  folder_.write("a.gltf", node_at(1, "Door"));
  const Outcome outcome = compare("HEAD --format markdown");
  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(outcome.out, AllOf(HasSubstr("### a\\.gltf\n"), HasSubstr("node.moved")));
}

TEST_F(CompareGit, TheExamplesForCiWriteAComment) {
  folder_.write("a.gltf", node_at(0, "Door"));
  commit("git update-ref refs/remotes/origin/main HEAD");
  folder_.write("a.gltf", node_at(1, "Door"));
  for (const char* name : {"github.yml", "gitlab-ci.yml"}) {
    const std::string example = read_file(std::string(GLTFX_SOURCE_DIR "/examples/ci/") + name);
    const std::size_t begin = example.find("gltfx compare --git");
    ASSERT_NE(begin, std::string::npos) << name;
    const std::string line = example.substr(begin, example.find('\n', begin) - begin);
    const Outcome outcome = shell(
        "export GITHUB_BASE_REF=main\n"
        "export CI_MERGE_REQUEST_DIFF_BASE_SHA=$(git rev-parse HEAD)\n"
        "set -e\n" +
        line);
    EXPECT_EQ(outcome.code, 0) << name << outcome.err;
    EXPECT_THAT(content("changes.md"), HasSubstr("### a\\.gltf\n")) << name;
  }
}

}  // namespace
}  // namespace gltfx::program
