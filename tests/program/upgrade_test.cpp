// SPDX-License-Identifier: Apache-2.0
/// `gltfx upgrade` from outside: its output, its files, and what it does not change.
#include <filesystem>

#include <gmock/gmock.h>

#include "program/upgrade_support.hpp"

namespace gltfx::program {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

const std::string kNeedsImage = R"({"asset":{"version":"2.0"},
"extensionsUsed":["KHR_materials_translucency"],"textures":[{}],"materials":[{"extensions":
{"KHR_materials_translucency":{"translucencyFactor":1,"translucencyTexture":{"index":0}}}}]})";
const std::string kLossy = R"({"asset":{"version":"2.0"},
"extensionsUsed":["KHR_materials_translucency","KHR_animation_pointer"],
"animations":[{"channels":[{"target":{"path":"pointer","extensions":{"KHR_animation_pointer":
{"pointer":"/materials/0/pbrMetallicRoughness/baseColorFactor"}}},"sampler":0}],"samplers":[]}],
"materials":[{"extensions":{"KHR_materials_translucency":{"translucencyFactor":1}}}]})";

TEST_F(UpgradeTest, WithoutAWritingOptionItOnlyTellsThePlan) {
  folder_.write("leaf.gltf", kLegacy);
  const Outcome outcome = here({"leaf.gltf"});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, AllOf(StartsWith("leaf.gltf\n"), HasSubstr("/materials/0/extensions/"),
                                 HasSubstr("to KHR_materials_diffuse_transmission, safe"),
                                 HasSubstr("read as v1: it has no"), HasSubstr("1 can be upgraded"),
                                 HasSubstr("nothing was written")));
  EXPECT_EQ(content("leaf.gltf"), kLegacy);
}

TEST_F(UpgradeTest, InPlaceChangesTheSpansAndKeepsTheMode) {
  const fs::path file = folder_.write("leaf.gltf", kLegacy);
  ::chmod(file.c_str(), 0604);
  EXPECT_EQ(here({"leaf.gltf", "--in-place"}).code, 0);
  EXPECT_EQ(content("leaf.gltf"), kUpgraded);
  EXPECT_EQ(status("leaf.gltf").st_mode & 07777U, 0604U);
  EXPECT_THAT(names(), ElementsAre("leaf.gltf"));
}

TEST_F(UpgradeTest, ABinaryFileGetsANewJsonChunkAndKeepsTheRest) {
  const std::string old = read_file(fixture("legacy/lantern.glb"));
  folder_.write("lantern.glb", old);
  EXPECT_EQ(here({"lantern.glb", "--in-place"}).code, 0);
  const std::string fresh = content("lantern.glb");
  EXPECT_EQ(fresh, read_file(fixture("legacy/upgraded/lantern.glb")));
  const std::size_t bin = old.rfind(std::string("BIN\0", 4)) - 4;
  EXPECT_EQ(fresh.substr(fresh.size() - (old.size() - bin)), old.substr(bin));
  EXPECT_EQ(here({"lantern.glb", "--check"}).code, 0);
}

TEST_F(UpgradeTest, AFileWithNothingToDoIsNotTouched) {
  folder_.write("leaf.gltf", kUpgraded);
  const auto before = status("leaf.gltf");
  const Outcome outcome = here({"leaf.gltf", "--in-place", "--backup"});
  EXPECT_EQ(outcome.code, 0);
  EXPECT_EQ(outcome.out, "1 file, nothing legacy\n");
  EXPECT_EQ(status("leaf.gltf").st_ino, before.st_ino);
  EXPECT_EQ(status("leaf.gltf").st_mtim.tv_nsec, before.st_mtim.tv_nsec);
  EXPECT_EQ(status("leaf.gltf").st_ctim.tv_nsec, before.st_ctim.tv_nsec);
  EXPECT_THAT(names(), ElementsAre("leaf.gltf"));
}

TEST_F(UpgradeTest, CheckTellsByTheExitCode) {
  folder_.write("old.gltf", kLegacy);
  folder_.write("new.gltf", kUpgraded);
  EXPECT_EQ(here({"old.gltf", "new.gltf", "--check"}).code, 1);
  EXPECT_EQ(here({"new.gltf", "--check"}).code, 0);
  EXPECT_EQ(content("old.gltf"), kLegacy);
}

TEST_F(UpgradeTest, TheDiffCanBeApplied) {
  folder_.write("leaf.gltf", kLegacy);
  const Outcome outcome = here({"leaf.gltf", "--diff"});
  EXPECT_EQ(outcome.code, 0);
  EXPECT_THAT(outcome.out, StartsWith("--- a/leaf.gltf\n+++ b/leaf.gltf\n@@ -1,10 +1,10 @@\n"));
  EXPECT_THAT(outcome.err, HasSubstr("1 can be upgraded"));
  folder_.write("leaf.diff", outcome.out);
  const Outcome applied =
      bash("patch -p1 < leaf.diff || exit 77", {folder_.path().native(), {}, {}});
  if (applied.code == 77) GTEST_SKIP() << "there is no patch program";
  EXPECT_EQ(content("leaf.gltf"), kUpgraded);
}

TEST_F(UpgradeTest, TheDiffOfAFolderCanBeAppliedByGitAndByPatch) {
  if (bash("command -v git && command -v patch").code != 0)
    GTEST_SKIP() << "git or patch is missing";
  const std::vector<std::string> files{
      "plain.gltf",    "a b.gltf",   "deep dir/x y.gltf",        "q\"uote.gltf",
      "back\\s.gltf",  "t\tab.gltf", "new\nline.gltf",           "\xC3\xA4.gltf",
      "-dash 's.gltf", " lead.gltf", "2020-01-01 00:00:00 .gltf"};
  for (const std::string& file : files) folder_.write("in/" + file, kLegacy);
  folder_.write("in/lantern.glb", read_file(fixture("legacy/lantern.glb")));
  const auto apply = [&](const std::string& folder, const std::string& tool) {
    for (const std::string& file : files) folder_.write("in/" + file, kLegacy);
    const Outcome outcome = bash("git init -q . && cd '" + folder +
                                     "' && \"$GLTFX\" upgrade \"$OLDPWD/in\" --diff >/dev/null "
                                     "&& \"$GLTFX\" upgrade . --diff > \"$OLDPWD/patch.diff\" && " +
                                     tool + " < \"$OLDPWD/patch.diff\"",
                                 {folder_.path().native(), {}, {}});
    EXPECT_EQ(outcome.code, 0) << outcome.out << outcome.err;
    for (const std::string& file : files) EXPECT_EQ(content("in/" + file), kUpgraded) << file;
  };
  apply("in", "git apply");
  apply("in", "patch -p1");
  apply(".", "git apply");
  EXPECT_THAT(content("patch.diff"), HasSubstr("# --- a/in/lantern.glb\n# +++ b/in/lantern.glb\n"));
}

TEST_F(UpgradeTest, TheDiffNamesALinkedFileByItsOwnName) {
  folder_.write("leaf.gltf", kLegacy);
  folder_.link("link.gltf", "leaf.gltf");
  EXPECT_THAT(here({"link.gltf", "--diff"}).out, StartsWith("--- a/leaf.gltf\n+++ b/leaf.gltf\n"));
  const std::string outside = here({(folder_.path() / "leaf.gltf").native(), "--diff"}).out;
  EXPECT_THAT(outside, StartsWith("--- a/leaf.gltf\n"));
}

TEST_F(UpgradeTest, AnAssetOfAnOlderFormatIsLeftToDoAndToldWhatConvertsIt) {
  folder_.write("old.gltf", R"({"asset":{"version":"1.0"}})");
  folder_.write("old.glb", std::string("glTF\1\0\0\0\x14\0\0\0\0\0\0\0\0\0\0\0", 20));
  for (const char* file : {"old.gltf", "old.glb"}) {
    const Outcome outcome = here({file, "--check"});
    EXPECT_EQ(outcome.code, 1) << outcome.err;
    EXPECT_THAT(outcome.out, AllOf(HasSubstr("left alone: not possible"),
                                   HasSubstr("npx gltf-pipeline -i OLD -o NEW")));
    EXPECT_EQ(here({file, "--in-place"}).code, 1);
    EXPECT_EQ(here({file, "--check", "--only", "KHR_xmp"}).code, 0);
  }
}

TEST_F(UpgradeTest, ALegacyNameWithoutObjectsIsToBeRemoved) {
  folder_.write("a.gltf", R"({"asset":{"version":"2.0"},"extensionsUsed":["KHR_xmp"],)"
                          R"("extensionsRequired":["KHR_xmp"]})");
  const Outcome outcome = here({"a.gltf", "--check"});
  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(outcome.out, AllOf(HasSubstr("/extensionsUsed/0"), HasSubstr("/extensionsRequired/0"),
                                 HasSubstr("no object has KHR_xmp")));
  EXPECT_EQ(here({"a.gltf", "--in-place"}).code, 0);
  EXPECT_EQ(content("a.gltf"), R"({"asset":{"version":"2.0"}})");
  EXPECT_EQ(here({"a.gltf", "--check"}).code, 0);
}

TEST_F(UpgradeTest, ABackupKeepsTheOldBytesAndIsNeverOverwritten) {
  folder_.write("leaf.gltf", kLegacy);
  EXPECT_EQ(here({"leaf.gltf", "--in-place", "--backup"}).code, 0);
  EXPECT_EQ(content("leaf.gltf.bak"), kLegacy);
  folder_.write("leaf.gltf", kLegacy + "\n");
  const Outcome again = here({"leaf.gltf", "--in-place", "--backup"});
  EXPECT_EQ(again.code, 4);
  EXPECT_THAT(again.err, HasSubstr("leaf.gltf.bak"));
  EXPECT_EQ(content("leaf.gltf.bak"), kLegacy);
  EXPECT_EQ(content("leaf.gltf"), kLegacy + "\n");
}

TEST_F(UpgradeTest, WhatNeedsAnImageIsLeftAndSaidSo) {
  folder_.write("a.gltf", kNeedsImage);
  const Outcome outcome = here({"a.gltf", "--in-place", "--unsafe"});
  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(outcome.out,
              AllOf(HasSubstr("left alone: needs an image"), HasSubstr("0 upgraded, 1 left")));
  EXPECT_EQ(content("a.gltf"), kNeedsImage);
}

TEST_F(UpgradeTest, WhatIsLostIsOnlyDoneWhenAskedFor) {
  folder_.write("a.gltf", kLossy);
  const Outcome left = here({"a.gltf", "--in-place"});
  EXPECT_EQ(left.code, 1);
  EXPECT_THAT(left.out, HasSubstr("left alone: unsafe"));
  EXPECT_EQ(content("a.gltf"), kLossy);
  EXPECT_EQ(here({"a.gltf", "--in-place", "--unsafe"}).code, 0);
  EXPECT_THAT(content("a.gltf"), HasSubstr("diffuseTransmissionFactor"));
}

TEST_F(UpgradeTest, StrictLeavesTheWholeFile) {
  std::string both = kLossy;
  both.insert(both.rfind("]}"),
              R"(,{"extensions":{"KHR_materials_translucency":{"translucencyFactor":1}}})");
  folder_.write("a.gltf", both);
  const Outcome outcome = here({"a.gltf", "--in-place", "--strict", "--unsafe"});
  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(outcome.err, HasSubstr("--strict"));
  EXPECT_EQ(content("a.gltf"), both);
  EXPECT_EQ(here({"a.gltf", "--in-place"}).code, 1);
  EXPECT_THAT(content("a.gltf"), AllOf(HasSubstr("diffuseTransmissionFactor"),
                                       HasSubstr("translucencyFactor\":1}}},")));
}

TEST_F(UpgradeTest, AnAssetThatIsNamedTwiceIsDoneOnce) {
  folder_.write("leaf.gltf", kLegacy);
  folder_.link("link.gltf", "leaf.gltf");
  const Outcome outcome = here({"link.gltf", "./leaf.gltf", "leaf.gltf", ".", "--in-place"});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("1 file, 1 legacy object: 1 upgraded"));
  EXPECT_TRUE(fs::is_symlink(folder_.path() / "link.gltf"));
  EXPECT_EQ(content("leaf.gltf"), kUpgraded);
}

TEST_F(UpgradeTest, HardLinksReadOnlyFilesAndPointersAreRefused) {
  folder_.write("linked.gltf", kLegacy);
  fs::create_hard_link(folder_.path() / "linked.gltf", folder_.path() / "other.gltf");
  ::chmod(folder_.write("locked.gltf", kLegacy).c_str(), 0444);
  folder_.write("lfs.gltf", "version https://git-lfs.github.com/spec/v1\noid sha256:" +
                                std::string(64, 'a') + "\nsize 12345\n");
  EXPECT_EQ(here({"linked.gltf", "--in-place"}).code, 4);
  const Outcome locked = here({"locked.gltf", "--in-place"});
  EXPECT_EQ(locked.code, 4);
  EXPECT_THAT(locked.err, HasSubstr("read-only"));
  EXPECT_THAT(locked.out, HasSubstr("0 upgraded, 1 left"));
  const Outcome pointer = here({"lfs.gltf", "--in-place"});
  EXPECT_EQ(pointer.code, 3);
  EXPECT_THAT(pointer.err, HasSubstr("Git LFS"));
  EXPECT_EQ(content("linked.gltf"), kLegacy);
  EXPECT_EQ(content("locked.gltf"), kLegacy);
}

TEST_F(UpgradeTest, ErrorsThatLeaveNoDoubtAreNoHindrance) {
  const std::string twice = R"({"asset":{"version":"2.0"},"asset":{"version":"2.0"},)" +
                            kLegacy.substr(1, kLegacy.size() - 2) + ",}";
  folder_.write("twice.gltf", twice);
  const Outcome outcome = here({"twice.gltf", "--in-place"});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(content("twice.gltf"), R"({"asset":{"version":"2.0"},"asset":{"version":"2.0"},)" +
                                       kUpgraded.substr(1, kUpgraded.size() - 2) + ",}");
}

TEST_F(UpgradeTest, ErrorsOfTheContainerAreMendedOrRefusedByName) {
  const std::string old = read_file(fixture("legacy/lantern.glb"));
  std::string wrong = old;
  wrong[8] = 1;  // the length of the file
  folder_.write("wrong.glb", wrong);
  EXPECT_EQ(here({"wrong.glb", "--in-place"}).code, 0);
  EXPECT_EQ(content("wrong.glb"), read_file(fixture("legacy/upgraded/lantern.glb")));
  std::string zeros = old;
  const std::size_t padding = zeros.find(" ", zeros.rfind('}', zeros.find("BIN")));
  for (std::size_t i = padding; i < zeros.find("BIN") - 4; ++i) zeros[i] = '\0';
  folder_.write("zeros.glb", zeros);
  EXPECT_EQ(here({"zeros.glb", "--in-place"}).code, 0);
  EXPECT_EQ(content("zeros.glb"), read_file(fixture("legacy/upgraded/lantern.glb")));
  folder_.write("cut.glb", old.substr(0, old.size() - 2));
  const Outcome cut = here({"cut.glb", "--in-place"});
  EXPECT_EQ(cut.code, 1);
  EXPECT_THAT(cut.err, HasSubstr("the file ends after"));
}

TEST_F(UpgradeTest, ErrorsThatLeaveDoubtAreNamedWithTheirPlace) {
  const std::string twice =
      R"({"materials":[],"extensionsUsed":["KHR_materials_translucency"],
"materials":[{"extensions":{"KHR_materials_translucency":{"translucencyFactor":1}}}]})";
  folder_.write("twice.gltf", twice);
  folder_.write("broken.gltf", R"({"materials":)");
  const Outcome outcome = here({"twice.gltf", "--in-place"});
  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(outcome.err, HasSubstr("its JSON is ambiguous at line 2, column 1"));
  EXPECT_THAT(outcome.out, HasSubstr("left alone with the whole file"));
  EXPECT_EQ(content("twice.gltf"), twice);
  EXPECT_EQ(here({"broken.gltf", "twice.gltf", "--check"}).code, 3);
}

TEST_F(UpgradeTest, FilesThatCannotBeReadAreCountedApart) {
  const Outcome alone = here({"nothing.gltf"});
  EXPECT_EQ(alone.code, 3);
  EXPECT_EQ(alone.out, "1 file could not be read\n");
  folder_.write("leaf.gltf", kUpgraded);
  EXPECT_EQ(here({"nothing.gltf", "leaf.gltf"}).out,
            "1 file, nothing legacy; 1 file could not be read\n");
}

TEST_F(UpgradeTest, ManyFilesOnSeveralThreadsComeInOrder) {
  for (int i = 0; i < 60; ++i) {
    folder_.write("d/" + std::to_string(100 + i) + ".gltf", i % 2 == 0 ? kLegacy : kUpgraded);
  }
  const Outcome plan = here({"d", "--jobs", "2"});
  EXPECT_EQ(plan.out, here({"d", "--jobs", "1"}).out);
  const Outcome outcome = here({"d", "--in-place", "--jobs", "2"});
  EXPECT_EQ(outcome.code, 0);
  EXPECT_THAT(outcome.out, HasSubstr("60 files, 30 legacy objects: 30 upgraded, 0 left; 30 files"));
  EXPECT_EQ(here({"d", "--check"}).code, 0);
}

TEST_F(UpgradeTest, WordsThatDoNotGoTogetherAreRefused) {
  folder_.write("leaf.gltf", kLegacy);
  for (const std::vector<std::string>& words : {std::vector<std::string>{},
                                                {"leaf.gltf", "--in-place", "-o", "x"},
                                                {"leaf.gltf", "--check", "--in-place"},
                                                {"leaf.gltf", "--backup"},
                                                {"leaf.gltf", "--generation", "v4"},
                                                {"leaf.gltf", "--root", "nowhere"}}) {
    const Outcome outcome = here(words);
    EXPECT_EQ(outcome.code, 2);
    EXPECT_THAT(outcome.err, StartsWith("gltfx: "));
  }
  EXPECT_EQ(content("leaf.gltf"), kLegacy);
}

TEST_F(UpgradeTest, AVendorsOwnExtensionFollowsItsSchema) {
  folder_.write("ACME_new.schema.json", R"({
    "$schema": "https://json-schema.org/draft/2020-12/schema", "$id": "gltfx:ext/ACME_new",
    "title": "ACME_new", "description": "New.", "type": "object",
    "properties": {"amount": {"type": "number"}},
    "x-gltfx": {"extension": "ACME_new", "on": ["node"], "status": "vendor"}})");
  folder_.write("ACME_old.schema.json", R"({
    "$schema": "https://json-schema.org/draft/2020-12/schema", "$id": "gltfx:ext/ACME_old",
    "title": "ACME_old", "description": "Old.", "type": "object",
    "properties": {"much": {"type": "number"}},
    "x-gltfx": {"extension": "ACME_old", "on": ["node"], "status": "vendor", "upgrade": {
      "to": "ACME_new", "steps": [{"step": "move", "from": "much", "to": "amount"}]}}})");
  folder_.write("a.gltf", R"({"asset":{"version":"2.0"},"extensionsUsed":["ACME_old"],)"
                          R"("nodes":[{"extensions":{"ACME_old":{"much":3}}}]})");
  EXPECT_EQ(here({"a.gltf", "--in-place", "--schema-dir", "."}).code, 0);
  EXPECT_EQ(content("a.gltf"), R"({"asset":{"version":"2.0"},"extensionsUsed":["ACME_new"],)"
                               R"("nodes":[{"extensions":{"ACME_new":{"amount":3}}}]})");
}

}  // namespace
}  // namespace gltfx::program
