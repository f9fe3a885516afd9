// SPDX-License-Identifier: Apache-2.0
/// Each option of `gltfx bake`: its effect, and the message when it cannot be met.
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

// Squares, a lamp, a camera, two scenes, two variants and an animation.
constexpr const char* kStage = R"json({"asset": {"version": "2.0"},
 "extensionsUsed": ["KHR_materials_variants", "KHR_lights_punctual"],
 "extensions": {"KHR_materials_variants": {"variants": [{"name": "red"}, {"name": "blue"}]}, "KHR_lights_punctual": {"lights": [{"type": "point", "intensity": 3, "color": [1, 0.5, 0.2]}]}},
 "scene": 0,
 "scenes": [{"name": "one", "nodes": [0, 1, 2, 3]}, {"name": "two", "nodes": [0, 1, 4]}],
 "nodes": [{"mesh": 0}, {"camera": 0, "name": "eye", "translation": [0.4, 0.3, 4]}, {"translation": [0.5, 0.5, 1], "extensions": {"KHR_lights_punctual": {"light": 0}}}, {"mesh": 0, "translation": [0, 0, -1], "scale": [2, 2, 2]}, {"mesh": 0, "translation": [0, 1.5, 0]}],
 "cameras": [{"name": "front", "type": "perspective", "perspective": {"yfov": 0.8, "znear": 0.1}}],
 "materials": [{"pbrMetallicRoughness": {"baseColorFactor": [0.8, 0.2, 0.2, 1], "metallicFactor": 0, "roughnessFactor": 0.3}}, {"pbrMetallicRoughness": {"baseColorFactor": [0.2, 0.2, 0.8, 1]}}],
 "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1, "material": 0, "extensions": {"KHR_materials_variants": {"mappings": [{"material": 1, "variants": [1]}]}}}]}],
 "animations": [{"name": "slide", "channels": [{"sampler": 0, "target": {"node": 0, "path": "translation"}}], "samplers": [{"input": 2, "output": 3}]}],
 "accessors": [{"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3", "min": [-1, -1, 0], "max": [1, 1, 0]}, {"bufferView": 1, "componentType": 5123, "count": 6, "type": "SCALAR"}, {"bufferView": 2, "componentType": 5126, "count": 2, "type": "SCALAR", "min": [0], "max": [1]}, {"bufferView": 3, "componentType": 5126, "count": 2, "type": "VEC3"}],
 "bufferViews": [{"buffer": 0, "byteLength": 48}, {"buffer": 0, "byteOffset": 48, "byteLength": 12}, {"buffer": 0, "byteOffset": 60, "byteLength": 8}, {"buffer": 0, "byteOffset": 68, "byteLength": 24}],
 "buffers": [{"byteLength": 92, "uri": "data:application/octet-stream;base64,AACAvwAAgL8AAAAAAACAPwAAgL8AAAAAAACAPwAAgD8AAAAAAACAvwAAgD8AAAAAAAABAAIAAAACAAMAAAAAAAAAgD8AAAAAAAAAAAAAAAAAAAA/AAAAAAAAAAA="}]})json";

class BakeOptionsTest : public testing::Test {
 protected:
  BakeOptionsTest() { folder_.write("stage.gltf", kStage); }

  Outcome run(std::vector<std::string> words) const {
    words.insert(words.begin(), "bake");
    return gltfx(std::move(words), {folder_.path().native(), {}, {}});
  }
  std::string content(const std::string& name) const {
    return read_file((folder_.path() / name).native());
  }
  /// The picture that these words give.
  std::string picture(std::vector<std::string> words) const {
    words.insert(words.begin(),
                 {"stage.gltf", "-o", "a.png", "--size", "16", "--samples", "20", "--jobs", "1"});
    const Outcome outcome = run(words);
    EXPECT_EQ(outcome.code, 0) << outcome.err << testing::PrintToString(words);
    return content("a.png");
  }
  std::string complaint(std::vector<std::string> words, int code) const {
    words.insert(words.begin(), "stage.gltf");
    words.insert(words.end(), {"--size", "8", "--samples", "1"});
    const Outcome outcome = run(words);
    EXPECT_EQ(outcome.code, code) << outcome.err << testing::PrintToString(words);
    return outcome.err;
  }
  const TempFolder folder_;
};

TEST_F(BakeOptionsTest, EachChangesThePicture) {
  const std::string usual = picture({});
  EXPECT_THAT(usual, StartsWith("\x89PNG"));
  EXPECT_EQ(usual, picture({}));
  ASSERT_EQ(run({fixture("good/leaf.gltf"), "-o", "sky.exr", "--size", "8x4", "--samples", "4",
                 "--exposure", "3"})
                .code,
            0);
  const std::vector<std::vector<std::string>> changes{
      {"--camera", "front"},
      {"--camera", "80,10"},
      {"--camera", "top", "--projection", "orthographic"},
      {"--projection", "orthographic"},
      {"--frame", "0"},
      {"--interior", "on"},
      {"--lights", "asset"},
      {"--lights", "studio"},
      {"--environment", "sky.exr"},
      {"--exposure", "1"},
      {"--scene", "two"},
      {"--animation", "slide", "--time", "0.5"},
      {"--variant", "blue"},
      {"--quality", "draft"},
      {"--bounces", "0"},
      {"--denoise", "off"},
      {"--noise", "0.9"},
      {"--seed", "7"},
      {"--background", "transparent"},
      {"--background", "environment"},
      {"--background", "#0080ff"},
      {"--background", "white"},
      {"--rotate-environment", "90"},
      {"--environment", "sky.exr", "--background", "studio"},
      {"--tone-map", "aces"},
      {"--tone-map", "agx"},
      {"--tone-map", "none"},
      {"--overlay", "clay"},
      {"--overlay", "wireframe"},
      {"--overlay", "uv"},
      {"--overlay", "density"},
      {"--overlay", "facing"},
      {"--shader", "spec"},
  };
  for (const auto& words : changes) {
    EXPECT_NE(picture(words), usual) << testing::PrintToString(words);
  }
  // A name and its index are the same, and so are an omitted option and its default.
  EXPECT_EQ(picture({"--camera", "0"}), picture({"--camera", "front"}));
  EXPECT_EQ(picture({"--frame", "/nodes/3"}), picture({"--frame", "3"}));
  EXPECT_EQ(picture({"--scene", "1"}), picture({"--scene", "two"}));
  EXPECT_EQ(picture({"--variant", "1"}), picture({"--variant", "blue"}));
  EXPECT_EQ(picture({"--animation", "0"}), picture({"--animation", "slide", "--time", "0"}));
  EXPECT_EQ(picture({"--background", "FFF"}), picture({"--background", "white"}));
  EXPECT_EQ(picture({"--background", "#08f"}), picture({"--background", "0088ff"}));
  EXPECT_EQ(picture({"--environment", "sky.exr", "--background", "environment"}),
            picture({"--environment", "sky.exr"}));
  for (const auto& words :
       std::vector<std::vector<std::string>>{{"--lights", "both"},
                                             {"--background", "studio"},
                                             {"--rotate-environment", "0"},
                                             {"--rotate-environment", "-360"},
                                             {"--tone-map", "neutral"},
                                             {"--projection", "perspective"},
                                             {"--interior", "auto"},
                                             {"--animation", "none"},
                                             {"--if-present"},
                                             {"--if-present", "--variant", "green"},
                                             {"--interior", "off"},
                                             {"--exposure", "0"},
                                             {"--scene", "one"},
                                             {"--quality", "standard"},
                                             {"--bounces", "6"},
                                             {"--denoise", "on"},
                                             {"--noise", "0"},
                                             {"--seed", "0"},
                                             {"--shader", "conserving"},
                                             {"--time-budget", "0"},
                                             {"--strict"},
                                             {"--isolated"},
                                             {"--color", "never"},
                                             {"--root", "."},
                                             {"--jobs", "2"}}) {
    EXPECT_EQ(picture(words), usual) << testing::PrintToString(words);
  }
}

TEST_F(BakeOptionsTest, FilesThatAreWritten) {
  const Outcome outcome = run({"stage.gltf",
                               "-o",
                               "out/a.webp",
                               "--size",
                               "8,8x4,8",
                               "--turntable",
                               "2",
                               "--layout",
                               "files",
                               "--layer",
                               "albedo,depth",
                               "--layer",
                               "normal",
                               "--layer",
                               "material",
                               "--samples",
                               "1",
                               "--sheet",
                               "sheet.jpg",
                               "--time-budget",
                               "5"});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  int files = 0;
  for (const auto& entry : fs::directory_iterator(folder_.path() / "out")) {
    EXPECT_THAT(read_file(entry.path().native()), StartsWith("RIFF"));
    ++files;
  }
  EXPECT_EQ(files, 2 * 2 * 5) << "sizes once, each all around, with four layers";
  EXPECT_TRUE(fs::exists(folder_.path() / "out/a-8x4-001-material.webp"));
  EXPECT_THAT(content("sheet.jpg"), StartsWith("\xff\xd8"));
  const auto written = [&](std::vector<std::string> words) {
    words.insert(words.begin(), {"stage.gltf", "--size", "8", "--samples", "1"});
    const Outcome done = run(words);
    EXPECT_EQ(done.code, 0) << done.err;
    return done.out;
  };
  written({"-o", "thumbnail", "--format", "png"});
  EXPECT_THAT(content("thumbnail"), StartsWith("\x89PNG"));
  EXPECT_EQ(written({"-o", "a.webp", "--clip", "slide", "--fps", "3"}), "stage.gltf -> a.webp\n");
  EXPECT_EQ(written({"-o", "a.png", "--turntable", "3", "--layout", "sprites"}),
            "stage.gltf -> a.png\n");
  EXPECT_EQ(written({"-o", "a.png", "--camera", "top", "--camera", "iso", "--camera", "top"}),
            "stage.gltf -> a.top.png\nstage.gltf -> a.iso.png\n");
}

TEST_F(BakeOptionsTest, WhatIsNotThereIsNamedWithWhatIs) {
  EXPECT_THAT(complaint({"-o", "a.png", "--camera", "side"}, 1),
              HasSubstr("no camera 'side'; there is 'front'; front, back, left"));
  EXPECT_THAT(complaint({"-o", "a.png", "--frame", "eyes"}, 1), HasSubstr("Did you mean 'eye'?"));
  EXPECT_THAT(complaint({"-o", "a.png", "--frame", "4"}, 1),
              HasSubstr("nothing of node '4' and its children is visible"));
  EXPECT_THAT(complaint({"-o", "a.png", "--frame", "0", "--camera", "0"}, 1),
              HasSubstr("use another camera to frame a node"));
  EXPECT_THAT(complaint({"-o", "a.png", "--variant", "green"}, 1),
              HasSubstr("no variant 'green'; there is 'red', 'blue'"));
  EXPECT_THAT(complaint({"-o", "a.png", "--scene", "2"}, 1),
              HasSubstr("no scene '2'; there is 'one', 'two'"));
  EXPECT_THAT(complaint({"-o", "a.png", "--animation", "walk"}, 1),
              HasSubstr("no animation 'walk'; there is 'slide'"));
  EXPECT_THAT(complaint({"-o", "a.png", "--environment", "gone.hdr"}, 3),
              HasSubstr("gone.hdr' does not exist"));
  folder_.write("bad.hdr", "hello");
  EXPECT_THAT(complaint({"-o", "a.png", "--environment", "bad.hdr"}, 3),
              HasSubstr("'bad.hdr' cannot be read"));
  folder_.write("sky.tif", "hello");
  EXPECT_THAT(complaint({"-o", "a.png", "--environment", "sky.tif"}, 3),
              HasSubstr("'sky.tif' has no known image format"));
  EXPECT_THAT(complaint({"-o", "a.jpg", "--background", "transparent"}, 1),
              HasSubstr("PNG, WebP and OpenEXR can"));
  EXPECT_THAT(complaint({"-o", "a.png", "--turntable", "3", "--camera", "0"}, 1),
              HasSubstr("around the asset"));
  EXPECT_FALSE(fs::exists(folder_.path() / "a.png"));
}

TEST_F(BakeOptionsTest, WordsThatDoNotGoTogetherAreRefusedBeforeAnythingIsDrawn) {
  const std::vector<std::pair<std::vector<std::string>, std::string>> cases{
      {{"-o", "a.tga"}, "--output: 'a.tga' does not end in .png"},
      {{"-o", "a.png", "--sheet", "s.tga"}, "--sheet: 's.tga' does not end in .png"},
      {{"-o", "a.tga", "--compare", "stage.gltf"}, "--output: 'a.tga' does not end in .png"},
      {{"-o", "a.png", "--format", "webp"}, "--format: the ending of 'a.png' is that"},
      {{"-o", "a.png", "--fps", "3"}, "are for the frames of a --turntable or --clip"},
      {{"-o", "a.png", "--layout", "sprites"}, "are for the frames of a --turntable or --clip"},
      {{"-o", "a.png", "--clip", "0", "--turntable", "3"}, "are mutually exclusive"},
      {{"-o", "a.png", "--clip", "0", "--animation", "0"}, "are mutually exclusive"},
      {{"--compare", "stage.gltf", "--clip", "0"}, "--compare draws one picture"},
      {{"--compare", "stage.gltf", "--camera", "0", "--camera", "top"}, "a second --camera"},
      {{"-o", "out/", "--format", "tiff"}, "--format: 'tiff' is not one of"},
      {{"--compare", "stage.gltf", "--turntable", "2"}, "--compare draws one picture"},
      {{"--compare", "stage.gltf", "--layer", "depth"}, "--compare draws one picture"},
      {{"--compare", "stage.gltf", "--sheet", "s.png"}, "--compare draws no --sheet"},
      {{"--compare", "stage.gltf", "--embed"}, "are mutually exclusive"},
      {{"--embed", "--layer", "depth"}, "say where --layer goes"},
      {{"-o", "a.png", "--time", "1"}, "--time is that of an --animation"},
      {{"-o", "a.png", "--bounces", "many"}, "--bounces: 'many' is not a whole number"},
      {{"-o", "a.png", "--turntable", "1e3"}, "--turntable: '1e3' is not a whole number"},
      {{"-o", "a.png", "--time-budget", "-1"}, "--time-budget: '-1' is not a number from 0"},
      {{"-o", "a.png", "--projection", "iso"}, "not one of perspective, orthographic"},
      {{"-o", "a.png", "--interior", "yes"}, "--interior: 'yes' is not one of auto, on, off"},
      {{"-o", "a.png", "--quality", "best"},
       "--quality: 'best' is not one of draft, standard, final"},
      {{"-o", "a.png", "--shader", "toon"}, "--shader: 'toon' is not one of spec, conserving"},
      {{"-o", "a.png", "--tone-map", "filmic"},
       "--tone-map: 'filmic' is not one of neutral, aces, agx, none"},
      {{"-o", "a.png", "--background", "blue"}, "--background: 'blue' is not studio"},
      {{"-o", "a.png", "--background", "#12345"}, "or a color such as white, black or #ff8800"},
      {{"-o", "a.png", "--background", "#12345g"}, "--background: '#12345g' is not studio"},
      {{"-o", "a.png", "--root", "gone"}, "--root: 'gone' is not a folder"},
  };
  for (const auto& [words, expected] : cases) {
    EXPECT_THAT(complaint(words, 2), HasSubstr(expected));
  }
  EXPECT_FALSE(fs::exists(folder_.path() / "a.png"));
}

TEST_F(BakeOptionsTest, SchemasOfOnesOwnAndTheConfigurationHold) {
  std::string text = kStage;
  const std::string materials = "\"materials\": [{";
  text.insert(text.find(materials) + materials.size(), "\"extensions\": {\"ACME_leaf\": {}},");
  text.insert(text.find("[\"KHR_materials_variants\"") + 1, "\"ACME_leaf\", ");
  folder_.write("leaf.gltf", text);
  const auto drawn = [&](std::vector<std::string> words) {
    words.insert(words.begin(),
                 {"leaf.gltf", "-o", "a.png", "--size", "8", "--samples", "1", "--strict"});
    return run(words).code;
  };
  EXPECT_EQ(drawn({}), 0) << "of an unknown extension nothing is known";
  EXPECT_EQ(drawn({"--schema", fixture("schemas/ACME_leaf.schema.json")}), 1) << "no age";
  EXPECT_EQ(drawn({"--schema-dir", fixture("schemas")}), 1);
  folder_.write("own.toml", "environment = \"gone.hdr\"\n");
  EXPECT_EQ(drawn({"--config", "own.toml"}), 3);
  EXPECT_EQ(drawn({"--config", "gone.toml"}), 2);
  folder_.write("own.toml", "frame = \"gone\"\n");
  EXPECT_EQ(drawn({"--config", "own.toml"}), 1);
  EXPECT_EQ(drawn({"--config", "own.toml", "--frame", "0"}), 0);
  folder_.write("own.toml", "projection = \"flat\"\n");
  EXPECT_EQ(drawn({"--config", "own.toml"}), 2);
  folder_.write("own.toml", "tone-map = \"agx\"\nbackground = \"#0080ff\"\n");
  EXPECT_EQ(picture({"--config", "own.toml"}),
            picture({"--tone-map", "agx", "--background", "0080ff"}));
}

}  // namespace
}  // namespace gltfx::program
