// SPDX-License-Identifier: Apache-2.0
// Several pictures of one asset: turntables, clips and cameras, as files or as one file.
#include <algorithm>
#include <filesystem>
#include <numeric>

#include <gmock/gmock.h>

#include "pipeline/bake_names.hpp"
#include "pipeline/baking.hpp"

namespace gltfx::test {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::HasSubstr;

std::uint32_t little(const std::string& file, std::size_t at, std::size_t bytes) {
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < bytes; ++i) {
    value |= static_cast<std::uint32_t>(static_cast<unsigned char>(file.at(at + i))) << (8 * i);
  }
  return value;
}

// Milliseconds of the frames of an animation in WebP (WebP Container Specification).
std::vector<std::uint32_t> durations_of(const std::string& webp) {
  std::vector<std::uint32_t> durations;
  for (std::size_t at = 12; at + 8 <= webp.size();) {
    if (webp.compare(at, 4, "ANMF") == 0) durations.push_back(little(webp, at + 8 + 12, 3));
    const std::size_t size = little(webp, at + 4, 4);
    at += 8 + size + size % 2;
  }
  return durations;
}

BakedPixels read_pixels(const fs::path& path, codec::ImageFormat format) {
  const std::string file = file_content(path);
  codec::ImageRequest request;
  request.bytes = std::as_bytes(std::span(file));
  request.format = format;
  request.pixels = true;
  const auto result = codec::Client::shared().decode_image(request);
  const auto* image = std::get_if<codec::Image>(&result);
  EXPECT_NE(image, nullptr) << path;
  if (image == nullptr) return {};
  const auto* bytes = reinterpret_cast<const std::uint8_t*>(image->pixels.data());
  return {image->width, image->height, image->channels, {bytes, bytes + image->pixels.size()}};
}

// A cube that moves by 4 m in a second, and jumps back.
AssetText moving_cube() {
  AssetText asset;
  const int node = asset.draw(scaled(render::cube(), 0.5F), plastic());
  const std::vector<float> times{0, 1};
  const std::vector<Float3> places{{-2, 0, 0}, {2, 0, 0}};
  const int input = asset.accessor("SCALAR", 5126, 2, packed(times), {{"min", {0}}, {"max", {1}}});
  const int output = asset.accessor("VEC3", 5126, 2, packed(places));
  const Json channel{{"sampler", 0}, {"target", {{"node", node}, {"path", "translation"}}}};
  const Json sampler{{"input", input}, {"output", output}};
  asset.add("animations", {{"name", "slide"},
                           {"channels", Json::array({channel})},
                           {"samplers", Json::array({sampler})}});
  return asset;
}

class Frames : public Baking {
 protected:
  Frames() {
    options.cameras.clear();
    options.quality = BakeQuality::draft;
    options.samples = 4;
    options.background = {BakeBackground::Kind::transparent};
    asset_ = moving_cube();
  }
  BakeReport bake_to(const std::string& name) {
    options.output = (folder.path() / name).native();
    return report(asset_);
  }
  std::vector<std::string> names_of(const BakeReport& done) const {
    EXPECT_EQ(done.problem, BakeProblem::none) << done.error;
    std::vector<std::string> names;
    for (const std::string& path : done.written)
      names.push_back(fs::path(path).filename().native());
    return names;
  }
  BakedPixels png(const std::string& name) const {
    return read_pixels(folder.path() / name, codec::ImageFormat::png);
  }
  // The mean place of what is seen, as part of the width.
  static double middle_of(const BakedPixels& pixels) {
    double sum = 0;
    double all = 0;
    for (std::size_t i = 0; i < std::size_t{pixels.width} * pixels.height; ++i) {
      const double alpha = pixels.bytes[i * 4 + 3];
      sum += alpha * (static_cast<double>(i % pixels.width) + 0.5) / pixels.width;
      all += alpha;
    }
    return all > 0 ? sum / all : -1;
  }

  AssetText asset_;
};

TEST_F(Frames, AClipMovesBeforeACameraThatStays) {
  options.cameras = {"front"};
  options.sizes = {{32, 16}};
  options.clip = "slide";
  options.fps = 4;
  EXPECT_THAT(names_of(bake_to("a.png")),
              ElementsAre("a-000.png", "a-001.png", "a-002.png", "a-003.png"));
  double last = 0;
  for (int i = 0; i < 4; ++i) {
    const double middle = middle_of(png("a-00" + std::to_string(i) + ".png"));
    EXPECT_GT(middle, last + 0.1) << "frame " << i;
    last = middle;
  }
  EXPECT_LT(last, 0.9) << "the last one is not beside the picture";
}

// Its material turns from nothing to opaque.
TEST_F(Frames, AClipMayBeginWithNothing) {
  const auto fade = [](float before, float after) {
    AssetText asset = moving_cube();
    asset.json()["materials"][0]["alphaMode"] = "MASK";
    asset.uses("KHR_animation_pointer");
    const int input =
        asset.accessor("SCALAR", 5126, 2, floats({0, 1}), {{"min", {0}}, {"max", {1}}});
    const int output = asset.accessor("VEC4", 5126, 2, floats({1, 1, 1, before, 1, 1, 1, after}));
    Json target{{"path", "pointer"}};
    target["extensions"]["KHR_animation_pointer"]["pointer"] =
        "/materials/0/pbrMetallicRoughness/baseColorFactor";
    Json& animation = asset.json()["animations"][0];
    animation["channels"].push_back({{"sampler", 1}, {"target", target}});
    animation["samplers"].push_back({{"input", input}, {"output", output}});
    return asset;
  };
  options.clip = "slide";
  options.fps = 4;
  asset_ = fade(0, 1);
  EXPECT_EQ(names_of(bake_to("a.png")).size(), 4U);
  EXPECT_EQ(middle_of(png("a-000.png")), -1) << "nothing is seen";
  EXPECT_EQ(middle_of(png("a-001.png")), -1);
  const double middle = middle_of(png("a-003.png"));
  EXPECT_GT(middle, 0.6) << "all frames that show it are in view";
  EXPECT_LT(middle, 0.9);
  asset_ = fade(0, 0);
  EXPECT_EQ(bake_to("b.png").problem, BakeProblem::nothing_to_see);
}

TEST_F(Frames, WebPIsAnAnimation) {
  options.clip = "0";
  EXPECT_THAT(names_of(bake_to("a.webp")), ElementsAre("a.webp"));
  const std::vector<std::uint32_t> durations = durations_of(file_content(folder.path() / "a.webp"));
  ASSERT_EQ(durations.size(), 24U) << "24 frames for one second";
  EXPECT_EQ(std::accumulate(durations.begin(), durations.end(), 0U), 1000U);
  options.clip.clear();
  options.turntable = 5;
  options.fps = 10;
  options.layers = {BakeLayer::depth};
  EXPECT_THAT(names_of(bake_to("b.webp")), ElementsAre("b.webp", "b-depth.webp"));
  EXPECT_THAT(durations_of(file_content(folder.path() / "b.webp")),
              ElementsAre(100, 100, 100, 100, 100));
  options.layers.clear();
  options.layout = BakeLayout::files;
  EXPECT_EQ(names_of(bake_to("c.webp")).size(), 5U);
  const BakedPixels still = read_pixels(folder.path() / "c-000.webp", codec::ImageFormat::webp);
  const BakedPixels moving = read_pixels(folder.path() / "b.webp", codec::ImageFormat::webp);
  ASSERT_EQ(still.bytes.size(), moving.bytes.size());
  double apart = 0;
  for (std::size_t i = 3; i < still.bytes.size(); i += 4) {
    apart += std::abs(still.bytes[i] - moving.bytes[i]);
  }
  EXPECT_LT(apart / static_cast<double>(still.bytes.size() / 4), 2) << "the first frame";
}

TEST_F(Frames, SpritesAreTheFramesInAGrid) {
  options.sizes = {{8, 6}};
  options.turntable = 5;
  options.layout = BakeLayout::sprites;
  EXPECT_THAT(names_of(bake_to("a.png")), ElementsAre("a.png"));
  const BakedPixels all = png("a.png");
  ASSERT_EQ(all.width, 24U);
  ASSERT_EQ(all.height, 12U);
  options.layout = BakeLayout::automatic;
  EXPECT_EQ(names_of(bake_to("b.png")).size(), 5U);
  for (std::size_t i = 0; i < 6; ++i) {
    const BakedPixels one = i < 5 ? png("b-00" + std::to_string(i) + ".png")
                                  : BakedPixels{8, 6, 4, std::vector<std::uint8_t>(192)};
    for (std::size_t y = 0; y < 6; ++y) {
      const auto* cell = &all.bytes[((i / 3 * 6 + y) * 24 + i % 3 * 8) * 4];
      EXPECT_TRUE(std::equal(cell, cell + 32, &one.bytes[y * 32])) << i << ", row " << y;
    }
  }
}

TEST_F(Frames, EachOfSeveralCamerasHasAFile) {
  options.cameras = {"front", "12.5,-3"};
  const BakeReport done = bake_to("a.png");
  EXPECT_THAT(names_of(done), ElementsAre("a.front.png", "a.12_5,-3.png"));
  EXPECT_NE(png("a.front.png").bytes, png("a.12_5,-3.png").bytes);
  EXPECT_EQ(done.pixels.bytes, png("a.front.png").bytes);
  options.sizes = {{8, 8}, {4, 4}};
  options.turntable = 2;
  EXPECT_THAT(names_of(bake_to("b.png")),
              ElementsAre("b.front-8x8-000.png", "b.front-8x8-001.png", "b.12_5,-3-8x8-000.png",
                          "b.12_5,-3-8x8-001.png", "b.front-4x4-000.png", "b.front-4x4-001.png",
                          "b.12_5,-3-4x4-000.png", "b.12_5,-3-4x4-001.png"));
  EXPECT_THAT(camera_file_parts({"a/b", "a.b", "../c"}), ElementsAre("a_b", "a_b_", "___c"));
}

TEST_F(Frames, TheFormatMayBeNamedInPlaceOfTheEnding) {
  options.format = BakeFormat::png;
  EXPECT_THAT(names_of(bake_to("picture")), ElementsAre("picture"));
  EXPECT_EQ(png("picture").width, 8U);
  EXPECT_THAT(names_of(bake_to("thumbnail.tmp")), ElementsAre("thumbnail.tmp"));
  options.cameras = {"front", "back"};
  EXPECT_THAT(names_of(bake_to("v1.2")), ElementsAre("v1.front.2", "v1.back.2"));
  options.format.reset();
  EXPECT_THAT(bake_to("picture").error, HasSubstr("does not end in .png"));
}

// As thumbnailing services make one, and read what they have open.
TEST_F(Frames, AnEmptyFileIsFilledInPlace) {
  std::ifstream open(folder.write("made.png", ""), std::ios::binary);
  EXPECT_THAT(names_of(bake_to("made.png")), ElementsAre("made.png"));
  const std::string seen{std::istreambuf_iterator<char>(open), {}};
  EXPECT_THAT(seen, testing::StartsWith("\x89PNG"));
  EXPECT_EQ(seen, file_content(folder.path() / "made.png"));
}

TEST_F(Frames, WhatDoesNotGoTogetherIsRefused) {
  const auto error = [&](const std::string& name) {
    const BakeReport done = bake_to(name);
    EXPECT_EQ(done.problem, BakeProblem::refused);
    return done.error;
  };
  options.layout = BakeLayout::sprites;
  EXPECT_THAT(error("a.png"), HasSubstr("a layout needs the frames of a turntable or clip"));
  options.clip = "run";
  EXPECT_THAT(error("a.png"), HasSubstr("no animation 'run'; there is 'slide'"));
  options.clip = "slide";
  options.layout = BakeLayout::animation;
  EXPECT_THAT(error("a.png"), HasSubstr("only WebP files can be animations"));
  options.layout = BakeLayout::sprites;
  options.sizes = {{4000, 4000}};
  EXPECT_THAT(error("a.png"), HasSubstr("24 frames of 4000x4000 pixels are too many"));
  options.sizes = {{1600, 1600}};
  options.cameras = {"front", "back", "top"};
  EXPECT_THAT(error("a.png"), HasSubstr("frames of 184320000 pixels would be in memory"));
  options.cameras.clear();
  options.layers = {BakeLayer::albedo, BakeLayer::depth};
  EXPECT_THAT(error("a.png"), HasSubstr("frames of 184320000 pixels would be in memory"));
  options.sizes = {{8, 8}};
  options.turntable = 3;
  EXPECT_THAT(error("a.png"), HasSubstr("a clip cannot be combined with a turntable"));
  options.turntable = 0;
  options.fps = -1;
  EXPECT_THAT(error("a.png"), HasSubstr("fps: neither 0 nor from 0.01 to 1000"));
}

TEST_F(Frames, TwoPicturesWithOneNameAreRefusedBeforeAnythingIsDrawn) {
  asset_.orthographic(1, 3);
  asset_.orthographic(1, 4);
  asset_.json()["cameras"][0]["name"] = "x";
  asset_.json()["cameras"][1]["name"] = "x-depth";
  options.cameras = {"x", "x-depth"};
  options.layers = {BakeLayer::depth};
  const BakeReport done = bake_to("a.png");
  EXPECT_EQ(done.problem, BakeProblem::refused);
  EXPECT_THAT(done.error, HasSubstr("a.x-depth.png"));
  EXPECT_TRUE(done.pixels.bytes.empty());
  EXPECT_FALSE(fs::exists(folder.path() / "a.x.png"));
}

TEST_F(Frames, WhatAnAssetLacksIsLeftOutIfAsked) {
  options.if_present = true;
  options.clip = "run";
  options.cameras = {"eye", "top"};
  options.layout = BakeLayout::sprites;
  const BakeReport done = bake_to("a.webp");
  EXPECT_THAT(names_of(done), ElementsAre("a.top.webp"));
  EXPECT_THAT(done.notes, ElementsAre(HasSubstr("no animation 'run'; there is 'slide'")))
      << "it has other animations, but no camera at all";
  options.clip.clear();
  options.layout = BakeLayout::automatic;
  options.cameras = {"eye"};
  options.animation = options.variant = options.scene = "none at all";
  EXPECT_THAT(names_of(bake_to("b.png")), ElementsAre("b.png"));
  options.if_present = false;
  EXPECT_EQ(bake_to("c.png").problem, BakeProblem::refused);
}

}  // namespace
}  // namespace gltfx::test
