// SPDX-License-Identifier: Apache-2.0
/// Places of `gltfx upgrade --output`, and the files that are copied with an asset.
#include <filesystem>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "program/upgrade_support.hpp"

namespace gltfx::program {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::HasSubstr;

using UpgradeOutput = UpgradeTest;

TEST_F(UpgradeOutput, OutputGoesToAFileOrAFolderWithWhatTheAssetNeeds) {
  std::string text = kLegacy;
  text.insert(text.find("  \"materials\""),
              "  \"buffers\": [{ \"uri\": \"parts/a%20b.bin\", \"byteLength\": 4 }],\n");
  folder_.write("in/leaf.gltf", text);
  folder_.write("in/parts/a b.bin", "1234");
  EXPECT_EQ(here({"in/leaf.gltf", "-o", "out/"}).code, 0);
  EXPECT_THAT(content("out/leaf.gltf"), HasSubstr("diffuseTransmissionFactor"));
  EXPECT_EQ(content("out/parts/a b.bin"), "1234");
  EXPECT_EQ(content("in/leaf.gltf"), text);
  EXPECT_EQ(here({"in/leaf.gltf", "-o", "in/new.gltf"}).code, 0);
  EXPECT_EQ(content("in/new.gltf"), content("out/leaf.gltf"));
  folder_.write("out/parts/a b.bin", "4321");
  const Outcome other = here({"in/leaf.gltf", "-o", "out/leaf.gltf"});
  EXPECT_EQ(other.code, 4);
  EXPECT_THAT(other.err, HasSubstr("other bytes"));
}

TEST_F(UpgradeOutput, OutputOfAFileWithoutLegacyObjectsIsACopy) {
  folder_.write("leaf.gltf", kUpgraded);
  EXPECT_EQ(here({"leaf.gltf", "-o", "out/copy.gltf"}).code, 0);
  EXPECT_FALSE(fs::is_directory(folder_.path() / "out/copy.gltf"));
  EXPECT_EQ(content("out/copy.gltf"), kUpgraded);
}

TEST_F(UpgradeOutput, FilesOutsideTheFolderAreNotLeftBehind) {
  std::string text = kLegacy;
  text.insert(text.find("  \"materials\""),
              "  \"buffers\": [{ \"uri\": \"../a.bin\", \"byteLength\": 4 }],\n");
  folder_.write("in/leaf.gltf", text);
  const Outcome outcome = here({"in/leaf.gltf", "-o", "out/"});
  EXPECT_EQ(outcome.code, 4);
  EXPECT_THAT(outcome.err, HasSubstr("outside the asset's folder"));
  EXPECT_FALSE(fs::exists(folder_.path() / "out/leaf.gltf"));
}

TEST_F(UpgradeOutput, ManyFilesMayShareWhatIsCopiedWithThem) {
  std::string text = kLegacy;
  text.insert(text.find("  \"materials\""),
              "  \"buffers\": [{ \"uri\": \"parts/a.bin\", \"byteLength\": 300000 }],\n");
  folder_.write("in/parts/a.bin", std::string(300'000, 'x'));
  for (int i = 0; i < 100; ++i) folder_.write("in/" + std::to_string(i) + ".gltf", text);
  const Outcome outcome = here({"in", "-o", "out", "--jobs", "2", "-q"});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(content("out/parts/a.bin").size(), 300'000U);
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_.path() / "out/parts"), {}), 1);
}

TEST_F(UpgradeOutput, TheTreeBelowAFolderIsKeptInTheOutputFolder) {
  folder_.write("in/leaf.gltf", kLegacy);
  folder_.write("in/deep/er/leaf.gltf", kLegacy);
  EXPECT_EQ(here({"in", "-o", "out"}).code, 0);
  EXPECT_EQ(content("out/leaf.gltf"), kUpgraded);
  EXPECT_EQ(content("out/deep/er/leaf.gltf"), kUpgraded);
  EXPECT_EQ(content("in/leaf.gltf"), kLegacy);
  EXPECT_EQ(here({"in/*.gltf", "-o", "matches"}).code, 0);
  EXPECT_EQ(content("matches/leaf.gltf"), kUpgraded);
}

TEST_F(UpgradeOutput, WhatAnEarlierRunWroteIsNoInput) {
  folder_.write("leaf.gltf", kLegacy);
  EXPECT_EQ(here({".", "-o", "out"}).code, 0);
  EXPECT_EQ(here({".", "-o", "out/"}).code, 0);
  EXPECT_EQ(content("out/leaf.gltf"), kUpgraded);
  EXPECT_FALSE(fs::exists(folder_.path() / "out/out"));
}

TEST_F(UpgradeOutput, AnOutputThatFitsNoInputIsAUsageErrorWithTheRemedy) {
  folder_.write("leaf.gltf", kLegacy);
  folder_.write("other.gltf", kLegacy);
  const std::vector<std::pair<std::vector<std::string>, std::string>> refused{
      {{"leaf.gltf", "-o", "new.glb"}, "has to end in .gltf"},
      {{"leaf.gltf", "-o", "out"}, "write 'out/' for a folder"},
      {{"leaf.gltf", "other.gltf", "-o", "new.gltf"}, "end it in '/'"},
      {{".", "-o", "other.gltf"}, "is a file, but a folder is needed"},
      {{"leaf.gltf", "-o", "other.gltf/"}, "is a file, but a folder is needed"},
      {{"-", "-o", "new.gltf"}, "standard input"}};
  for (const auto& [words, reason] : refused) {
    const Outcome outcome = here(words);
    EXPECT_EQ(outcome.code, 2) << reason;
    EXPECT_THAT(outcome.err, HasSubstr(reason));
  }
  EXPECT_THAT(names(), ElementsAre("leaf.gltf", "other.gltf"));
  EXPECT_EQ(here({"leaf.gltf", "-o", "new.GLTF"}).code, 0);
  EXPECT_EQ(content("new.GLTF"), kUpgraded);
}

TEST_F(UpgradeOutput, RestorePutsBackWhatBackupKept) {
  folder_.write("a.gltf", kLegacy);
  folder_.write("b.gltf", kUpgraded);
  ASSERT_EQ(here({".", "--in-place", "--backup"}).code, 0);
  ASSERT_EQ(content("a.gltf"), kUpgraded);
  EXPECT_EQ(here({".", "--restore", "--check"}).code, 2);
  const Outcome outcome = here({".", "--restore"});
  EXPECT_EQ(outcome.out, "./a.gltf: restored\n");
  EXPECT_EQ(outcome.code, 0);
  EXPECT_EQ(content("a.gltf"), kLegacy);
  EXPECT_EQ(names(), (std::vector<std::string>{"a.gltf", "b.gltf"}));
  const Outcome again = here({"a.gltf", "--restore"});
  EXPECT_EQ(again.code, 4);
  EXPECT_THAT(again.err, testing::HasSubstr("a.gltf: there is no 'a.gltf.bak'"));
  folder_.link("b.gltf.bak", "a.gltf");
  EXPECT_EQ(here({"b.gltf", "--restore"}).code, 4);
  EXPECT_EQ(content("b.gltf"), kUpgraded);
}

TEST_F(UpgradeOutput, JsonHasPlansAndOutcomes) {
  folder_.write("a.gltf", kLegacy);
  folder_.write("b.gltf", kUpgraded);
  folder_.write("c.gltf", "{");
  const Outcome plan = here({".", "--format", "json"});
  EXPECT_EQ(plan.code, 3);
  const auto report = nlohmann::json::parse(plan.out);
  ASSERT_EQ(report["files"].size(), 3U);
  const auto& first = report["files"][0];
  EXPECT_EQ(first["path"], "./a.gltf");
  EXPECT_EQ(first["changes"], true);
  EXPECT_EQ(first["written"], false);
  EXPECT_EQ(first["actions"][0]["from"], "KHR_materials_translucency");
  EXPECT_EQ(first["actions"][0]["to"], "KHR_materials_diffuse_transmission");
  EXPECT_EQ(first["actions"][0]["outcome"], "safe");
  EXPECT_EQ(report["files"][1]["actions"].size(), 0U);
  EXPECT_EQ(report["files"][2]["problem"], "unreadable");
  EXPECT_EQ(report["summary"]["done"], 1);
  const auto written =
      nlohmann::json::parse(here({"a.gltf", "--in-place", "--quiet", "--format", "json"}).out);
  EXPECT_EQ(written["files"][0]["writtenTo"], "a.gltf");
}

}  // namespace
}  // namespace gltfx::program
