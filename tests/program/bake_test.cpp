// SPDX-License-Identifier: Apache-2.0
/// `gltfx bake` from outside: its files, output and exit codes.
#include <filesystem>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "container/temp_folder.hpp"
#include "program/process.hpp"

namespace gltfx::program {
namespace {

namespace fs = std::filesystem;
using container::test::TempFolder;
using testing::HasSubstr;
using testing::StartsWith;

class BakeTest : public testing::Test {
 protected:
  Outcome bake(std::vector<std::string> words) const {
    words.insert(words.begin(), {"bake", "--size", "16", "--samples", "2"});
    return gltfx(std::move(words), {folder_.path().native(), {}, {}});
  }
  std::string content(const std::string& name) const {
    return read_file((folder_.path() / name).native());
  }
  void copy(const std::string& name) const {
    folder_.write(fs::path(name).filename().native(), read_file(fixture(name)));
  }
  const TempFolder folder_;
};

TEST_F(BakeTest, AFileBecomesAPicture) {
  const Outcome outcome = bake({fixture("good/leaf.gltf"), "-o", "leaf.png"});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("-> leaf.png\n"));
  EXPECT_EQ(outcome.err, "");
  EXPECT_THAT(content("leaf.png"), StartsWith("\x89PNG"));
}

TEST_F(BakeTest, ThreadsDoNotShow) {
  bake({fixture("good/leaf.gltf"), "-o", "one.png", "--jobs", "1"});
  bake({fixture("good/leaf.gltf"), "-o", "two.png", "--jobs", "2"});
  bake({fixture("good/leaf.gltf"), "-o", "other.png", "--seed", "1"});
  EXPECT_EQ(content("one.png"), content("two.png"));
  EXPECT_NE(content("one.png"), content("other.png"));
}

TEST_F(BakeTest, AFolderBecomesAFolderWithASheet) {
  fs::create_directory(folder_.path() / "in");
  folder_.write("in/a.glb", read_file(fixture("good/bowl.glb")));
  folder_.write("in/b.glb", read_file(fixture("good/tumbler.glb")));
  const Outcome outcome = bake({"in", "-o", "out", "--format", "webp", "--quiet"});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(outcome.out, "");
  EXPECT_THAT(content("out/a.webp"), StartsWith("RIFF"));
  EXPECT_TRUE(fs::exists(folder_.path() / "out/b.webp"));
  EXPECT_THAT(content("out/contact-sheet.png"), StartsWith("\x89PNG"));
}

TEST_F(BakeTest, WhatCanBeDrawnOfAnInvalidAssetIsDrawn) {
  std::string asset = read_file(fixture("good/lamp.gltf"));
  asset.insert(asset.find('{') + 1, R"("samplers": [], )");
  folder_.write("faulty.gltf", asset);
  folder_.write("lamp.bin", read_file(fixture("good/lamp.bin")));
  const Outcome outcome = bake({"faulty.gltf", "-o", "a.png"});
  EXPECT_EQ(outcome.code, 0);
  EXPECT_THAT(outcome.out, Not(HasSubstr("error[")));
  EXPECT_THAT(outcome.err, HasSubstr("it has 1 error, which gltfx validate names"));
  EXPECT_THAT(content("a.png"), StartsWith("\x89PNG"));
  const Outcome strict = bake({"faulty.gltf", "-o", "b.png", "--strict"});
  EXPECT_EQ(strict.code, 1);
  EXPECT_THAT(strict.out, HasSubstr("error[EMPTY_ENTITY]"));
  EXPECT_THAT(strict.err, HasSubstr("it has errors"));
  EXPECT_FALSE(fs::exists(folder_.path() / "b.png"));
}

TEST_F(BakeTest, SomeErrorsLeaveNoPicture) {
  folder_.write("old.gltf", R"({"asset": {"version": "1.0"}})");
  const Outcome outcome = bake({"old.gltf", "-o", "a.png"});
  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(outcome.out, HasSubstr("error[GLTF_VERSION_1]"));
  EXPECT_THAT(gltfx({"explain", "GLTF_VERSION_1"}).out,
              HasSubstr("draws no asset with this error"));
}

TEST_F(BakeTest, NothingToSeeIsNoPicture) {
  folder_.write("empty.gltf", kSound);
  const Outcome outcome = bake({"empty.gltf", "-o", "a.png"});
  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(outcome.err, HasSubstr("nothing in it is visible"));
  EXPECT_EQ(bake({"gone.gltf", "-o", "a.png"}).code, 3);
}

TEST_F(BakeTest, AMeshThatIsAPointIsNoPicture) {
  folder_.write("point.gltf", R"({"asset": {"version": "2.0"}, "scene": 0,
    "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
    "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
    "accessors": [{"bufferView": 0, "componentType": 5126, "type": "VEC3", "count": 3,
                   "min": [0, 0, 0], "max": [0, 0, 0]}],
    "bufferViews": [{"buffer": 0, "byteLength": 36, "target": 34962}],
    "buffers": [{"byteLength": 36, "uri": "data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAA"}]})");
  const Outcome outcome = bake({"point.gltf", "-o", "a.png"});
  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(outcome.err,
              HasSubstr("nothing in it is visible: all vertices of mesh 0 are at one place"));
}

TEST_F(BakeTest, EmbedWritesTheAsset) {
  copy("good/bowl.glb");
  const Outcome outcome = bake({"bowl.glb", "--embed"});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(outcome.out, "bowl.glb: thumbnail embedded\n");
  EXPECT_THAT(content("bowl.glb"), HasSubstr("\"thumbnail\""));
  const Outcome verdict =
      gltfx({"validate", (folder_.path() / "bowl.glb").native(), "--fail-on", "warning"});
  EXPECT_EQ(verdict.code, 0) << verdict.out;
  EXPECT_THAT(verdict.out, HasSubstr("info[PROPERTY_DRAFT]"));
  EXPECT_THAT(verdict.out, testing::Not(HasSubstr("UNUSED_OBJECT")));
  const Outcome khronos =
      gltfx({"validate", (folder_.path() / "bowl.glb").native(), "--profile", "khronos"});
  EXPECT_THAT(khronos.out, HasSubstr("[UNEXPECTED_PROPERTY]"));
}

TEST_F(BakeTest, CompareSaysHowMuchDiffers) {
  const Outcome same =
      bake({fixture("good/bowl.glb"), "--compare", fixture("good/bowl.glb"), "-o", "d.png"});
  EXPECT_EQ(same.code, 0) << same.err;
  EXPECT_EQ(same.out, "the same picture\n");
  EXPECT_TRUE(fs::exists(folder_.path() / "d.png"));
  const Outcome other = bake({fixture("good/bowl.glb"), "--compare", fixture("good/leaf.gltf")});
  EXPECT_THAT(other.out,
              testing::ContainsRegex("^PSNR [0-9]+\\.[0-9][0-9] dB, SSIM 0\\.[0-9]{4}\n$"));
}

TEST_F(BakeTest, ADifferenceIsWrittenInTheFormatThatIsNamed) {
  const std::string bowl = fixture("good/bowl.glb");
  const Outcome named =
      bake({bowl, "--compare", bowl, "-f", "png", "-o", "diff", "--camera", "eye", "--if-present"});
  EXPECT_EQ(named.code, 0) << named.err;
  EXPECT_THAT(content("diff"), testing::StartsWith("\x89PNG"));
  const auto refused = [&](std::vector<std::string> words) {
    words.insert(words.begin(), {"gone.glb", "--compare", bowl});
    const Outcome outcome = bake(words);
    EXPECT_EQ(outcome.code, 2) << "before anything is read";
    return outcome.err;
  };
  EXPECT_THAT(refused({"-o", "diff.exr"}), HasSubstr("which OpenEXR does not hold"));
  EXPECT_THAT(refused({"-o", "other", "-f", "exr"}), HasSubstr("which OpenEXR does not hold"));
  EXPECT_THAT(refused({"-o", "diff.png", "-f", "webp"}), HasSubstr("that of another format"));
  EXPECT_THAT(refused({"-o", "./", "-f", "png"}), HasSubstr("is a folder"));
}

TEST_F(BakeTest, WrongWordsAreNamed) {
  const std::string leaf = fixture("good/leaf.gltf");
  const std::vector<std::pair<std::vector<std::string>, std::string>> cases{
      {{leaf}, "say where the picture goes"},
      {{"-o", "a.png"}, "name at least one file"},
      {{leaf, "-o", "a.png", "--size", "0"}, "--size"},
      {{leaf, "-o", "a.png", "--size", "10x"}, "--size"},
      {{leaf, "-o", "a.png", "--samples", "-1"}, "--samples"},
      {{leaf, "-o", "a.png", "--lights", "sun"}, "not one of asset, studio, both"},
      {{leaf, "-o", "a.png", "--layer", "colour"}, "not one of albedo"},
      {{leaf, "-o", "a.png", "--noise", "2"}, "--noise"},
      {{leaf, "-o", "a.png", "--exposure", "nan"}, "--exposure"},
      {{leaf, "-o", "a.png", "--denoise", "yes"}, "not one of on, off"},
      {{leaf, "--embed", "--time-budget", "1"}, "are mutually exclusive"},
      {{"-", "-o", "a.png"}, "standard input"},
  };
  for (const auto& [words, expected] : cases) {
    const Outcome outcome = bake(words);
    EXPECT_EQ(outcome.code, 2) << expected;
    EXPECT_THAT(outcome.err, HasSubstr(expected));
  }
  EXPECT_THAT(bake({leaf, "-o", "a.tga"}).err, HasSubstr("does not end in .png"));
  EXPECT_EQ(bake({leaf, "-o", "a.tga"}).code, 2);
}

}  // namespace
}  // namespace gltfx::program
