// SPDX-License-Identifier: Apache-2.0
/// Files, folders, globs and standard input: the opened files and their order.
#include <filesystem>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "container/temp_folder.hpp"
#include "process.hpp"

namespace gltfx::program {
namespace {

using container::test::TempFolder;
using testing::ElementsAre;
using testing::HasSubstr;

class Input : public testing::Test {
 protected:
  // The files that were reported on, in order.
  std::vector<std::string> checked(const std::vector<std::string>& paths,
                                   const std::string& input = {}) {
    std::vector<std::string> arguments{"validate", "--format", "json"};
    arguments.insert(arguments.end(), paths.begin(), paths.end());
    outcome_ = gltfx(arguments, {folder_.path().native(), input, {}});
    std::vector<std::string> names;
    const auto report = nlohmann::json::parse(outcome_.out, nullptr, false);
    if (report.is_discarded()) return {"no JSON: " + outcome_.out + outcome_.err};
    for (const auto& file : report["files"]) names.push_back(file["path"]);
    return names;
  }

  TempFolder folder_;
  Outcome outcome_;
};

TEST_F(Input, FoldersAreSearchedThroughInSortedOrder) {
  folder_.write("a/z.gltf", kSound);
  folder_.write("a/b/y.glb", "glTF");
  folder_.write("a/B.GLTF", kSound);
  folder_.write("a/notes.txt", "");
  folder_.write("a/.git/x.gltf", kSound);
  folder_.write("a/.hidden/w.gltf", kSound);
  EXPECT_THAT(checked({"a"}), ElementsAre("a/.hidden/w.gltf", "a/B.GLTF", "a/b/y.glb", "a/z.gltf"));
}

TEST_F(Input, AvatarsInAFolderAreAssets) {
  folder_.write("a/chair.glb", "glTF");
  folder_.write("a/avatar.vrm", "glTF");
  folder_.write("b/AVATAR.VRM", "glTF");
  EXPECT_THAT(checked({"a"}), ElementsAre("a/avatar.vrm", "a/chair.glb"));
  EXPECT_THAT(checked({"b"}), ElementsAre("b/AVATAR.VRM"));
  for (const char* verb : {"fix", "upgrade", "inspect"}) {
    EXPECT_THAT(gltfx({verb, "b"}, {folder_.path().native(), {}, {}}).err,
                testing::Not(HasSubstr("no .gltf")))
        << verb;
  }
}

TEST_F(Input, ArgumentsKeepTheirOrderAndEachFileIsCheckedOnce) {
  folder_.write("a/1.gltf", kSound);
  folder_.write("b.gltf", kSound);
  EXPECT_THAT(checked({"b.gltf", "a", "a/1.gltf", "./b.gltf"}), ElementsAre("b.gltf", "a/1.gltf"));
}

TEST_F(Input, ListsNameFilesAndFoldersButNoPatterns) {
  folder_.write("a/1.gltf", kSound);
  folder_.write("a/2.gltf", kSound);
  folder_.write("[b].gltf", kSound);
  folder_.write("list", "[b].gltf\r\n\na\na/1.gltf\nnone*.gltf");
  EXPECT_THAT(checked({"--files-from", "list"}),
              ElementsAre("[b].gltf", "a/1.gltf", "a/2.gltf", "none*.gltf"));
  EXPECT_THAT(checked({"a/2.gltf", "--files-from", "-"}, std::string("a/1.gltf\0[b].gltf\0", 18)),
              ElementsAre("a/2.gltf", "a/1.gltf", "[b].gltf"));
  EXPECT_THAT(checked({"--files-from", "-"}, ""), ElementsAre());
}

TEST_F(Input, AListThatCannotBeReadIsAMistake) {
  EXPECT_EQ(gltfx({"validate", "--files-from", "nowhere"}, {folder_.path().native(), {}, {}}).code,
            2);
  const Outcome both = gltfx({"validate", "-", "--files-from", "-"});
  EXPECT_EQ(both.code, 2);
  EXPECT_THAT(both.err, HasSubstr("either a list or an asset"));
}

TEST_F(Input, LinkedFoldersAreEnteredOnlyWhenNamed) {
  folder_.write("real/1.gltf", kSound);
  folder_.link("all/loop", "..");
  folder_.link("all/2.gltf", "../real/1.gltf");
  EXPECT_THAT(checked({"all"}), ElementsAre("all/2.gltf"));
  folder_.link("named", "real");
  EXPECT_THAT(checked({"named"}), ElementsAre("named/1.gltf"));
}

TEST_F(Input, GlobsThatTheShellLeftAreExpanded) {
  folder_.write("a/1.gltf", kSound);
  folder_.write("a/b/2.gltf", kSound);
  folder_.write("a/b/2.txt", "");
  folder_.write("3.gltf", kSound);
  EXPECT_THAT(checked({"*.gltf"}), ElementsAre("3.gltf"));
  EXPECT_THAT(checked({"a/*"}), ElementsAre("a/1.gltf", "a/b/2.gltf"));
  EXPECT_THAT(checked({"**/*.gltf"}), ElementsAre("3.gltf", "a/1.gltf", "a/b/2.gltf"));
  EXPECT_THAT(checked({"a/?.gltf", "[0-9].gltf"}), ElementsAre("a/1.gltf", "3.gltf"));
}

// However many steps of a pattern go into a folder, it is looked into once for each.
TEST_F(Input, GlobsWithManyStepsOverFoldersEnd) {
  std::string deep = "a";
  for (int i = 0; i < 15; ++i) deep += "/b";
  folder_.write(deep + "/1.gltf", kSound);
  std::string pattern;
  for (int i = 0; i < 40; ++i) pattern += "**/";
  EXPECT_THAT(checked({pattern + "*.gltf"}), ElementsAre(deep + "/1.gltf"));
}

TEST_F(Input, AFileWhoseNameLooksLikeAGlobOrAListIsAFile) {
  folder_.write("[a,b].gltf", kSound);
  EXPECT_THAT(checked({"[a,b].gltf"}), ElementsAre("[a,b].gltf"));
}

TEST_F(Input, AGlobWithoutMatchBesideAnAssetIsUnreadable) {
  folder_.write("a.gltf", kSound);
  EXPECT_THAT(checked({"*.glb", "a.gltf"}), ElementsAre("*.glb", "a.gltf"));
  EXPECT_EQ(outcome_.code, 3);
  EXPECT_THAT(checked({"*.glb", "a.gltf", "--allow-empty"}), ElementsAre("a.gltf"));
  EXPECT_EQ(outcome_.code, 0);
}

TEST_F(Input, PathsThatLookLikeVerbsOrOptionsArePaths) {
  folder_.write("rules/1.gltf", kSound);
  folder_.write("--quiet.gltf", kSound);
  EXPECT_THAT(checked({"rules"}), ElementsAre("rules/1.gltf"));
  EXPECT_THAT(checked({"--", "--quiet.gltf"}), ElementsAre("--quiet.gltf"));
  EXPECT_THAT(checked({"./--quiet.gltf"}), ElementsAre("./--quiet.gltf"));
}

TEST_F(Input, StandardInputStandsAmongTheFiles) {
  folder_.write("1.gltf", kSound);
  folder_.write("2.gltf", kSound);
  EXPECT_THAT(checked({"1.gltf", "-", "2.gltf", "-"}, kFaulty),
              ElementsAre("1.gltf", "-", "2.gltf"));
  EXPECT_EQ(outcome_.code, 1);
}

TEST_F(Input, StandardInputTakesNoFilesUnlessToldWhere) {
  const std::string asset =
      R"({"asset": {"version": "2.0"}, "buffers": [{"uri": "secret.bin", "byteLength": 4}]})";
  folder_.write("secret.bin", "1234");
  checked({"-"}, asset);
  EXPECT_THAT(outcome_.out, HasSubstr("RESOURCE_NOT_CHECKED"));
  checked({"-", "--root", "."}, asset);
  EXPECT_THAT(outcome_.out, testing::Not(HasSubstr("RESOURCE_NOT_CHECKED")));
}

TEST_F(Input, AMissingFileDoesNotStopTheOthers) {
  folder_.write("1.gltf", kSound);
  EXPECT_THAT(checked({"gone.gltf", "1.gltf"}), ElementsAre("gone.gltf", "1.gltf"));
  EXPECT_EQ(outcome_.code, 3);
  EXPECT_THAT(outcome_.out, HasSubstr("IO_ERROR"));
  EXPECT_EQ(outcome_.err, "");
}

TEST_F(Input, AFolderWithoutAssetsBesideOthersIsANote) {
  std::filesystem::create_directory(folder_.path() / "void");
  folder_.write("a.gltf", kSound);
  EXPECT_THAT(checked({"void", "a.gltf"}), ElementsAre("a.gltf"));
  EXPECT_EQ(outcome_.code, 0);
  EXPECT_EQ(outcome_.err, "gltfx: note: no .gltf, .glb or .vrm in 'void'\n");
  checked({"void", "a.gltf", "--quiet"});
  EXPECT_EQ(outcome_.err, "");
}

// The options of a verb, without its inputs.
struct Asked {
  std::string verb;
  std::vector<std::string> options;
};

void PrintTo(const Asked& asked, std::ostream* out) { *out << asked.verb; }

class NothingFound : public testing::TestWithParam<Asked> {
 protected:
  NothingFound() {
    folder_.write("void/notes.txt", "");
    folder_.write("more/deep/notes.txt", "");
    folder_.write("list", "void\nmore\n");
    folder_.write("empty list", "");
  }
  Outcome run(const std::vector<std::string>& inputs) const {
    std::vector<std::string> words{GetParam().verb};
    words.insert(words.end(), GetParam().options.begin(), GetParam().options.end());
    words.insert(words.end(), inputs.begin(), inputs.end());
    return gltfx(words, {folder_.path().native(), {}, {}});
  }
  bool takes_lists() const { return GetParam().verb != "inspect"; }

  const TempFolder folder_;
};

TEST_P(NothingFound, IsAMistakeThatNamesTheInputs) {
  struct Case {
    std::vector<std::string> inputs;
    std::string said;
  };
  std::vector<Case> cases{{{"void"}, "no .gltf, .glb or .vrm in 'void'."},
                          {{"void/"}, "no .gltf, .glb or .vrm in 'void/'."},
                          {{"**/*.glb"}, "no .gltf, .glb or .vrm in '**/*.glb'."},
                          {{"*/"}, "no .gltf, .glb or .vrm in '*/'."},
                          {{"void", "more", "-q"}, "no .gltf, .glb or .vrm in 'void', 'more'."},
                          {{"void", "more", "more/deep", "*.glb", "*.gltf"},
                           "no .gltf, .glb or .vrm in 'void', 'more', 'more/deep' and 2 more."}};
  if (takes_lists()) {
    cases.push_back({{"--files-from", "list"}, "no .gltf, .glb or .vrm in 'void', 'more'."});
    cases.push_back({{"void", "--files-from", "empty list"}, "no .gltf, .glb or .vrm in 'void'."});
    cases.push_back({{"void", "--shard", "2/3"}, "no .gltf, .glb or .vrm in 'void'."});
  }
  for (const Case& each : cases) {
    const Outcome outcome = run(each.inputs);
    EXPECT_EQ(outcome.code, 2) << each.said;
    EXPECT_THAT(outcome.err, HasSubstr("gltfx: " + each.said + " Use --allow-empty"));
    EXPECT_EQ(outcome.out, "");
    EXPECT_FALSE(std::filesystem::exists(folder_.path() / "out")) << "nothing is written";
  }
}

TEST_P(NothingFound, IsNoneWhenAllowed) {
  for (const std::string input : {"void", "*.glb"}) {
    const Outcome outcome = run({input, "--allow-empty"});
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_THAT(outcome.err, HasSubstr("note: no .gltf, .glb or .vrm in '" + input + "'"));
    EXPECT_THAT(outcome.out + outcome.err, testing::Not(HasSubstr("contact-sheet")));
  }
  if (!takes_lists()) return;
  const Outcome outcome = run({"--files-from", "empty list"});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
}

INSTANTIATE_TEST_SUITE_P(
    Verbs, NothingFound,
    testing::Values(Asked{"validate", {}}, Asked{"validate", {"--format", "json"}},
                    Asked{"upgrade", {}}, Asked{"upgrade", {"--check"}},
                    Asked{"upgrade", {"-o", "out/"}}, Asked{"bake", {"-o", "out/"}},
                    Asked{"bake", {"-o", "out/", "--size", "64"}}, Asked{"inspect", {}},
                    Asked{"report", {"-o", "-", "--no-thumbnails"}}));

TEST_F(Input, AFolderThatCannotBeListedIsUnreadable) {
  if (::geteuid() == 0) GTEST_SKIP() << "root may list any folder";
  folder_.write("shut/1.gltf", kSound);
  std::filesystem::permissions(folder_.path() / "shut", std::filesystem::perms::none);
  checked({"."});
  EXPECT_EQ(outcome_.code, 3);
  std::filesystem::permissions(folder_.path() / "shut", std::filesystem::perms::owner_all);
}

TEST_F(Input, TheRootWidensWhatAnAssetMayUse) {
  folder_.write("models/1.gltf", R"({"asset": {"version": "2.0"},
      "buffers": [{"uri": "../shared/1.bin", "byteLength": 4}]})");
  folder_.write("shared/1.bin", "1234");
  checked({"models/1.gltf"});
  EXPECT_THAT(outcome_.out, HasSubstr("URI_OUTSIDE_ROOT"));
  EXPECT_EQ(outcome_.code, 1);
  checked({"models/1.gltf", "--root", "."});
  EXPECT_EQ(outcome_.code, 0) << outcome_.out;
}

}  // namespace
}  // namespace gltfx::program
