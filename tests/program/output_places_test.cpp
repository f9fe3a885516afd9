// SPDX-License-Identifier: Apache-2.0
/// Outputs of several inputs below one folder: each has a distinct name, or nothing is written.
#include <filesystem>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "program/upgrade_support.hpp"

namespace gltfx::program {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class OutputPlaces : public UpgradeTest {
 protected:
  Outcome run_here(std::vector<std::string> arguments) const {
    return gltfx(std::move(arguments), {folder_.path().native(), {}, {}});
  }
  bool is_there(const std::string& name) const { return fs::exists(folder_.path() / name); }
  void add_assets(const std::vector<std::string>& names) const {
    for (const std::string& name : names) folder_.write(name, kLegacy);
  }
  void add_bowls(const std::vector<std::string>& names) const {
    const std::string bowl = read_file(fixture("good/bowl.glb"));
    for (const std::string& name : names) folder_.write(name, bowl);
  }
};

const std::vector<std::string> kDraw{"bake", "--size", "8", "--samples", "1", "--quiet"};

std::vector<std::string> draw(const std::vector<std::string>& words) {
  std::vector<std::string> all = kDraw;
  all.insert(all.end(), words.begin(), words.end());
  return all;
}

TEST_F(OutputPlaces, PicturesOfAssetsWithOneNameHaveNamesOfTheirOwn) {
  add_bowls({"a/x/scene.glb", "b/x/scene.glb", "b/other.glb"});
  const Outcome outcome = run_here(
      draw({"a/x/scene.glb", "b/x/scene.glb", "b/other.glb", "-o", "out/", "--jobs", "2"}));
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  for (const std::string name : {"out/a/x/scene.png", "out/b/x/scene.png", "out/other.png"}) {
    EXPECT_TRUE(is_there(name)) << name;
  }
}

TEST_F(OutputPlaces, EveryVerbKeepsThemApart) {
  add_assets({"a/scene.gltf", "b/scene.gltf"});
  for (const std::vector<std::string>& verb : std::vector<std::vector<std::string>>{
           {"upgrade"}, {"fix"}, {"edit", "--delete", "/materials/0/name"}}) {
    std::vector<std::string> words = verb;
    const std::string output = verb.front() + "-out";
    words.insert(words.end(), {"a/scene.gltf", "b/scene.gltf", "-o", output + "/"});
    EXPECT_EQ(run_here(words).code, 0) << verb.front();
    EXPECT_TRUE(is_there(output + "/a/scene.gltf")) << verb.front();
    EXPECT_TRUE(is_there(output + "/b/scene.gltf")) << verb.front();
  }
}

// Named folders, as far as they are needed to distinguish their files.
TEST_F(OutputPlaces, WhatLiesBelowFoldersIsKeptApart) {
  add_assets({"old/a/scene.gltf", "new/a/scene.gltf", "new/b.gltf"});
  EXPECT_EQ(here({"old", "new", "-o", "out/"}).code, 0);
  for (const std::string name : {"out/old/a/scene.gltf", "out/new/a/scene.gltf", "out/b.gltf"}) {
    EXPECT_EQ(content(name), kUpgraded) << name;
  }
  EXPECT_EQ(here({"../" + folder_.path().filename().native() + "/old", "new", "-o", "out2"}).code,
            0);
  EXPECT_EQ(content("out2/old/a/scene.gltf"), kUpgraded);
}

TEST_F(OutputPlaces, ALongerNameThatIsTakenBecomesLongerItself) {
  add_assets({"x/a/scene.gltf", "scene.gltf", "in/a/scene.gltf"});
  EXPECT_EQ(here({"x/a/scene.gltf", "scene.gltf", "in", "-o", "out/"}).code, 0);
  for (const std::string name : {"x/a/scene.gltf", "scene.gltf", "in/a/scene.gltf"}) {
    EXPECT_EQ(content("out/" + name), kUpgraded) << name;
  }
}

TEST_F(OutputPlaces, WhatRemainsEqualIsRefusedBeforeAnythingIsWritten) {
  add_assets({"scene.gltf", "in/scene.gltf", "in/other.gltf"});
  const std::string inside = (folder_.path() / "in").native();
  const Outcome outcome = gltfx(
      {"upgrade", "other.gltf", "../scene.gltf", "scene.gltf", "-o", "out/"}, {inside, {}, {}});
  EXPECT_EQ(outcome.code, 2);
  EXPECT_THAT(outcome.err, HasSubstr("two inputs would be written to 'out/scene.gltf'"));
  EXPECT_FALSE(is_there("in/out"));
}

TEST_F(OutputPlaces, AnAssetOfTheRunIsNotReplacedByAnother) {
  add_assets({"a/scene.gltf", "b/a.gltf", "out/a/scene.gltf"});
  add_assets({"c/scene.gltf"});
  const Outcome outcome = here({"a/scene.gltf", "c/scene.gltf", "out/a/scene.gltf", "-o", "out/"});
  EXPECT_EQ(outcome.code, 2);
  EXPECT_THAT(outcome.err, HasSubstr("is an asset of this run"));
  EXPECT_EQ(content("out/a/scene.gltf"), kLegacy);
}

TEST_F(OutputPlaces, TheSheetIsNoPictureOfAnAsset) {
  add_bowls({"in/contact-sheet.glb", "in/b.glb"});
  const Outcome outcome = run_here(draw({"in", "-o", "out"}));
  EXPECT_EQ(outcome.code, 2);
  EXPECT_THAT(outcome.err, HasSubstr("--sheet"));
  EXPECT_FALSE(is_there("out"));
  EXPECT_EQ(run_here(draw({"in", "-o", "out", "--sheet", "all.png"})).code, 0);
  EXPECT_EQ(run_here(draw({"in", "-o", "other", "--sheet", "other/b.png"})).code, 2);
}

TEST_F(OutputPlaces, ALayerIsNoPictureOfAnotherAsset) {
  add_bowls({"in/bowl.glb", "in/bowl-depth.glb"});
  const Outcome outcome = run_here(draw({"in", "-o", "out", "--layer", "depth"}));
  EXPECT_EQ(outcome.code, 2);
  EXPECT_THAT(outcome.err, HasSubstr("two inputs would be written to 'out/bowl-depth.png'"));
  EXPECT_FALSE(is_there("out"));
}

TEST_F(OutputPlaces, NorOfOneOfAnotherShard) {
  add_bowls({"in/bowl.glb", "in/bowl-depth.glb"});
  for (const std::string shard : {"1/2", "2/2"}) {
    const Outcome outcome =
        run_here(draw({"in", "-o", "out", "--layer", "depth", "--shard", shard}));
    EXPECT_EQ(outcome.code, 2);
    EXPECT_THAT(outcome.err, HasSubstr("two inputs would be written to 'out/bowl-depth.png'"));
  }
  EXPECT_FALSE(is_there("out"));
}

TEST_F(OutputPlaces, SeveralViewsOfOneAssetAreNoPicturesOfAnother) {
  add_bowls({"in/bowl.glb", "in/bowl.top.glb"});
  std::vector<std::string> words = draw({"in", "-o", "out", "--camera", "top", "--camera", "iso"});
  EXPECT_EQ(run_here(words).code, 0) << "all of them have two";
  words = draw({"in", "-o", "other", "--camera", "top", "--camera", "0", "--if-present"});
  EXPECT_EQ(run_here(words).code, 0);
  fs::rename(folder_.path() / "in/bowl.top.glb", folder_.path() / "in/bowl.0.glb");
  const Outcome outcome =
      run_here(draw({"in", "-o", "gone", "--camera", "0", "--camera", "1", "--if-present"}));
  EXPECT_EQ(outcome.code, 2) << "an asset without these cameras has a picture without their names";
  EXPECT_THAT(outcome.err, HasSubstr("two inputs would be written to 'gone/bowl.0.png'"));
  EXPECT_FALSE(is_there("gone"));
}

TEST_F(OutputPlaces, TheSheetIsNoneOfSeveralPictures) {
  add_bowls({"bowl.glb"});
  const auto code = [&](const std::vector<std::string>& words, const std::string& sheet) {
    std::vector<std::string> all = draw({"bowl.glb", "-o", "out/a.png", "--sheet", sheet});
    all.insert(all.end(), words.begin(), words.end());
    const Outcome outcome = run_here(all);
    if (outcome.code != 0) {
      EXPECT_THAT(outcome.err, HasSubstr("--sheet: "));
    }
    return outcome.code;
  };
  EXPECT_EQ(code({}, "out/a.png"), 2);
  EXPECT_EQ(code({"--camera", "top", "--camera", "iso"}, "out/a.iso.png"), 2);
  EXPECT_EQ(code({"--size", "8", "--size", "4"}, "out/a-4x4.png"), 2);
  EXPECT_EQ(code({"--turntable", "2"}, "out/a-001.png"), 2);
  EXPECT_EQ(code({"--turntable", "2", "--layer", "depth"}, "out/a-001-depth.png"), 2);
  EXPECT_EQ(code({}, "out/sheet.exr"), 2) << "it has 8 bits a channel";
  EXPECT_FALSE(is_there("out"));
  EXPECT_EQ(code({"--turntable", "2"}, "out/a.png"), 0);
  EXPECT_EQ(code({"--camera", "top", "--camera", "iso"}, "out/a.png"), 0);
}

TEST_F(OutputPlaces, FramesAndLayersOfAnAssetAreNoPicturesOfAnother) {
  add_bowls({"in/bowl.glb", "in/bowl-depth.glb", "in/bowl-000.glb"});
  const Outcome apart = run_here(draw({"in", "-o", "out", "--turntable", "2", "--layer", "depth"}));
  EXPECT_EQ(apart.code, 0) << apart.err;
  EXPECT_TRUE(is_there("out/bowl-000-depth.png"));
  EXPECT_TRUE(is_there("out/bowl-depth-000.png"));
  const Outcome still = run_here(draw({"in", "-o", "gone", "--clip", "walk", "--if-present"}));
  EXPECT_EQ(still.code, 2) << "one may have the clip, the other lack it";
  EXPECT_THAT(still.err, HasSubstr("two inputs would be written to 'gone/bowl-#.png'"));
  EXPECT_FALSE(is_there("gone"));
}

TEST_F(OutputPlaces, TwoPicturesOfAnAssetAreNotOneFile) {
  add_bowls({"bowl.glb"});
  const Outcome outcome = run_here(draw({"bowl.glb", "-o", "a.png", "--layer", "depth", "--camera",
                                         "x", "--camera", "x-depth", "--if-present"}));
  EXPECT_EQ(outcome.code, 2);
  EXPECT_THAT(outcome.err, HasSubstr("two pictures of 'bowl.glb' would be written to"));
}

}  // namespace
}  // namespace gltfx::program
