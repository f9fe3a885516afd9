// SPDX-License-Identifier: Apache-2.0
/// `gltfx convert`: where its output goes, what it says, and what it ends with.
#include <filesystem>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "container/temp_folder.hpp"
#include "process.hpp"

namespace gltfx::program {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;

class ConvertTest : public testing::Test {
 protected:
  ConvertTest() {
    add("a.gltf");
    folder_.write("b.bin", "abcd");
  }
  void add(const std::string& name) {
    folder_.write(name,
                  R"({"asset":{"version":"2.0"},"buffers":[{"uri":"b.bin","byteLength":4}]})");
  }
  Outcome here(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), "convert");
    return gltfx(std::move(arguments), {folder_.path().native(), {}, {}});
  }
  bool has(const std::string& name) const { return fs::exists(folder_.path() / name); }

  container::test::TempFolder folder_;
};

TEST_F(ConvertTest, IsADryRunUnlessToldWhereToWrite) {
  const Outcome outcome = here({"a.gltf", "--to", "glb"});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, AllOf(HasSubstr("container  one GLB, 1 buffer"), HasSubstr("-> "),
                                 HasSubstr("1 can be converted; nothing was written")));
  EXPECT_EQ(folder_.entries(), 2);
  EXPECT_EQ(here({"a.gltf", "--to", "glb", "--check"}).code, 1);
  EXPECT_EQ(here({"a.gltf", "--check"}).code, 0);
}

TEST_F(ConvertTest, AQualityNeedsImagesThatItIsOf) {
  const Outcome outcome = here({"a.gltf", "--quality", "30"});
  EXPECT_EQ(outcome.code, 2);
  EXPECT_THAT(outcome.err, HasSubstr("--quality requires --images or --texture-size"));
}

TEST_F(ConvertTest, AVersionOfGlbsIsForGlbs) {
  EXPECT_EQ(here({"a.gltf", "--to", "glb", "--glb", "3", "--check"}).code, 1);
  EXPECT_EQ(here({"a.gltf", "--to", "glb", "--glb", "4"}).code, 2);
  for (const std::vector<std::string>& more :
       {std::vector<std::string>{"-o", "out/a.gltf"}, {"--to", "embedded"}}) {
    std::vector<std::string> arguments{"a.gltf", "--glb", "3"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Outcome outcome = here(arguments);
    EXPECT_EQ(outcome.code, 2);
    EXPECT_THAT(outcome.err, HasSubstr("--glb is for GLBs, but the output is a .gltf"));
  }
}

TEST_F(ConvertTest, BoundsMayFollowQuantize) {
  EXPECT_EQ(here({"--quantize", "a.gltf", "--check"}).code, 0);
  EXPECT_EQ(here({"a.gltf", "--check", "--quantize"}).code, 0);
  EXPECT_EQ(here({"--quantize", "position=1%,color=off", "a.gltf", "--check"}).code, 0);
  EXPECT_EQ(here({"--quantize=normal=1deg", "a.gltf", "--check"}).code, 0);
  folder_.write("a=b.gltf", R"({"asset":{"version":"2.0"}})");
  EXPECT_EQ(here({"--quantize", "a=b.gltf", "--check"}).code, 0);
  const Outcome outcome = here({"--quantize", "postion=1%", "a.gltf"});
  EXPECT_EQ(outcome.code, 2);
  EXPECT_THAT(outcome.err,
              HasSubstr("'postion' is no bound of a loss; did you mean 'position'?\n"));
}

TEST_F(ConvertTest, ANameThatBeginsWithTwoDotsIsInTheFolder) {
  folder_.write("dots.gltf",
                R"({"asset":{"version":"2.0"},"buffers":[{"uri":"...bin","byteLength":4}]})");
  folder_.write("...bin", "abcd");
  EXPECT_EQ(here({"dots.gltf", "-o", "new/dots.gltf"}).code, 0);
  EXPECT_TRUE(has("new/...bin"));
}

TEST_F(ConvertTest, TheNameTellsTheFormAndMayNotContradictIt) {
  EXPECT_EQ(here({"a.gltf", "-o", "new/a.glb"}).code, 0);
  EXPECT_TRUE(read_file((folder_.path() / "new/a.glb").native()).starts_with("glTF"));
  EXPECT_EQ(here({"new/a.glb", "-o", "back/a.gltf"}).code, 0);
  EXPECT_TRUE(has("back/a.bin"));
  const Outcome wrong = here({"a.gltf", "-o", "new/b.gltf", "--to", "glb"});
  EXPECT_EQ(wrong.code, 2);
  EXPECT_THAT(wrong.err, HasSubstr("--to glb contradicts the ending .gltf of --output"));
  const Outcome in_place = here({"a.gltf", "--in-place", "--to", "glb"});
  EXPECT_EQ(in_place.code, 2);
  EXPECT_THAT(in_place.err, HasSubstr("--in-place keeps the container"));
}

TEST_F(ConvertTest, AFolderGetsNamesThatEndAsTheForm) {
  add("more/c.gltf");
  folder_.write("more/b.bin", "efgh");
  const Outcome outcome = here({".", "-o", "out/", "--to", "glb", "-j", "2"});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_TRUE(has("out/a.glb"));
  EXPECT_TRUE(has("out/more/c.glb"));
  EXPECT_FALSE(has("out/b.bin"));
  const Outcome again = here({".", "-o", "out/", "--to", "glb"});
  EXPECT_THAT(again.out, HasSubstr("2 files written"));
}

TEST_F(ConvertTest, WhatIsRefusedIsNamedAndTheExitCodeIsOne) {
  fs::remove(folder_.path() / "b.bin");
  const Outcome outcome = here({"a.gltf", "-o", "a.glb"});
  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(outcome.out, HasSubstr("refused /buffers/0: "));
  EXPECT_THAT(outcome.err, HasSubstr("(--partial writes the rest)"));
  EXPECT_FALSE(has("a.glb"));
  EXPECT_EQ(here({"a.gltf", "-o", "a.glb", "--partial"}).code, 1);
  EXPECT_TRUE(has("a.glb"));
  EXPECT_EQ(here({"none.gltf", "-o", "a.glb"}).code, 3);
}

TEST_F(ConvertTest, AnImageThatCannotBeReadIsNotSkipped) {
  folder_.write("i.gltf", R"({"asset":{"version":"2.0"},"images":[{"uri":"none.png"}],)"
                          R"("textures":[{"source":0}]})");
  const Outcome outcome = here({"i.gltf", "--images", "png", "-o", "out/i.gltf"});
  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(outcome.err, HasSubstr("/images/0: 'none.png' does not exist (--partial"));
  EXPECT_FALSE(has("out"));
  EXPECT_EQ(here({"i.gltf", "--images", "png", "-o", "out/i.gltf", "--partial"}).code, 1);
  EXPECT_TRUE(has("out/i.gltf"));
}

// Another asset that cannot be read may refer to the file that would change.
TEST_F(ConvertTest, InPlaceAFileStaysIfItsOtherUsersAreUnknown) {
  folder_.write("own/b.bin", "abcdefghijklmnop");
  folder_.write("own/a.gltf",
                R"({"asset":{"version":"2.0"},"buffers":[{"uri":"b.bin","byteLength":16}],)"
                R"("bufferViews":[{"buffer":0,"byteLength":8},)"
                R"({"buffer":0,"byteOffset":8,"byteLength":8}],)"
                R"("accessors":[{"bufferView":0,"componentType":5121,"count":4,"type":"SCALAR"}],)"
                R"("images":[{"bufferView":1,"mimeType":"image/png"}]})");
  fs::create_symlink("../a.gltf", folder_.path() / "own/away.gltf");
  const Outcome refused = here({"own/a.gltf", "--prune", "--in-place"});
  EXPECT_EQ(refused.code, 1);
  EXPECT_THAT(refused.err, HasSubstr("away.gltf' cannot be read; another asset may refer to"));
  fs::remove(folder_.path() / "own/away.gltf");
  EXPECT_EQ(here({"own/a.gltf", "--prune", "--in-place"}).code, 0);
  EXPECT_EQ(fs::file_size(folder_.path() / "own/b.bin"), 8U);
}

TEST_F(ConvertTest, JsonHasARowForEachStep) {
  const Outcome outcome = here({"a.gltf", "--to", "glb", "--format", "json"});
  EXPECT_EQ(outcome.code, 0);
  const auto json = nlohmann::json::parse(outcome.out);
  const auto& step = json["files"][0]["steps"][0];
  EXPECT_EQ(step["step"], "container");
  EXPECT_EQ(step["what"], "one GLB, 1 buffer");
  EXPECT_EQ(step["changed"], true);
  EXPECT_THAT(step["left"], IsEmpty());
  EXPECT_THAT(step["refused"], IsEmpty());
  EXPECT_THAT(step["loss"], IsEmpty());
  EXPECT_EQ(step["bytes_before"], 74);
  EXPECT_GT(step["bytes_after"], step["bytes_before"]);
  EXPECT_EQ(json["summary"]["changed"], 1);
}

TEST_F(ConvertTest, TheDiffIsThatOfTheText) {
  const Outcome outcome = here({"a.gltf", "--to", "glb", "--diff"});
  EXPECT_THAT(outcome.out,
              HasSubstr(R"(# +{"asset":{"version":"2.0"},"buffers":[{"byteLength":4}]})"));
}

}  // namespace
}  // namespace gltfx::program
