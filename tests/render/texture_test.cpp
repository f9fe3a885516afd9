// SPDX-License-Identifier: Apache-2.0
#include "render/texture.hpp"

#include <cmath>
#include <cstring>
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "render/tonemap.hpp"

namespace gltfx::render {
namespace {

using testing::ElementsAre;
using testing::FloatEq;

// Two texels side by side: red 0 and 255.
Texture ramp(Wrap wrap, Filter filter = Filter::nearest) {
  static const std::array<std::uint8_t, 6> kBytes{0, 10, 20, 255, 110, 120};
  Texture texture;
  texture.width = 2;
  texture.height = 1;
  texture.channels = 3;
  texture.pixels = std::as_bytes(std::span(kBytes));
  texture.wrap_s = texture.wrap_t = wrap;
  texture.filter = filter;
  return texture;
}

float red(const Texture& texture, float u, float v = 0.5F) {
  return sample_texture(texture, u, v, false)[0];
}

TEST(Texture, NearestTakesTheTexelAtTheCoordinate) {
  EXPECT_EQ(red(ramp(Wrap::repeat), 0.1F), 0);
  EXPECT_EQ(red(ramp(Wrap::repeat), 0.49F), 0);
  EXPECT_EQ(red(ramp(Wrap::repeat), 0.51F), 1);
}

TEST(Texture, RepeatGoesOnWithTheOtherEnd) {
  EXPECT_EQ(red(ramp(Wrap::repeat), 1.1F), 0);
  EXPECT_EQ(red(ramp(Wrap::repeat), -0.1F), 1);
  EXPECT_EQ(red(ramp(Wrap::repeat), -1.9F), 0);
}

TEST(Texture, MirroredRepeatTurnsBack) {
  EXPECT_EQ(red(ramp(Wrap::mirrored_repeat), 1.1F), 1);
  EXPECT_EQ(red(ramp(Wrap::mirrored_repeat), 1.9F), 0);
  EXPECT_EQ(red(ramp(Wrap::mirrored_repeat), -0.1F), 0);
  EXPECT_EQ(red(ramp(Wrap::mirrored_repeat), -0.9F), 1);
  EXPECT_EQ(red(ramp(Wrap::mirrored_repeat), 2.9F), 1);
}

TEST(Texture, ClampKeepsTheEdge) {
  EXPECT_EQ(red(ramp(Wrap::clamp_to_edge), 7.0F), 1);
  EXPECT_EQ(red(ramp(Wrap::clamp_to_edge), -7.0F), 0);
  EXPECT_EQ(red(ramp(Wrap::clamp_to_edge, Filter::linear), 0.1F), 0);
}

TEST(Texture, LinearBlendsBetweenMiddles) {
  EXPECT_FLOAT_EQ(red(ramp(Wrap::repeat, Filter::linear), 0.25F), 0);
  EXPECT_FLOAT_EQ(red(ramp(Wrap::repeat, Filter::linear), 0.5F), 0.5F);
  EXPECT_FLOAT_EQ(red(ramp(Wrap::repeat, Filter::linear), 0.625F), 0.75F);
  EXPECT_FLOAT_EQ(red(ramp(Wrap::repeat, Filter::linear), 1.0F), 0.5F);
}

TEST(Texture, ColoursAreDecodedBeforeTheyAreBlended) {
  const Float4 value = sample_texture(ramp(Wrap::repeat, Filter::linear), 0.5F, 0, true);
  EXPECT_FLOAT_EQ(value[0], 0.5F);
  EXPECT_NEAR(value[1], (srgb_decode(10.0F / 255) + srgb_decode(110.0F / 255)) / 2, 1e-6);
  EXPECT_EQ(value[3], 1);
}

TEST(Texture, GreyStandsForAllColours) {
  static const std::array<std::uint8_t, 2> kBytes{51, 102};
  Texture texture = ramp(Wrap::repeat);
  texture.width = 1;
  texture.channels = 2;
  texture.pixels = std::as_bytes(std::span(kBytes));
  EXPECT_THAT(sample_texture(texture, 0, 0, false),
              ElementsAre(FloatEq(0.2F), FloatEq(0.2F), FloatEq(0.2F), FloatEq(0.4F)));
  EXPECT_FLOAT_EQ(sample_texture(texture, 0, 0, true)[3], 0.4F);
  EXPECT_FLOAT_EQ(sample_channel(texture, 0, 0, 3), 0.4F);
  texture.channels = 1;
  EXPECT_FLOAT_EQ(sample_channel(texture, 0, 0, 3), 1);
  EXPECT_FLOAT_EQ(sample_channel(texture, 0, 0, 2), 0.2F);
}

TEST(Texture, SixteenBits) {
  static const std::array<std::uint16_t, 3> kWords{65535, 13107, 0};
  Texture texture = ramp(Wrap::repeat, Filter::linear);
  texture.width = 1;
  texture.bits = 16;
  texture.pixels = std::as_bytes(std::span(kWords));
  EXPECT_THAT(sample_texture(texture, 0.3F, 0.7F, false),
              ElementsAre(FloatEq(1), FloatEq(0.2F), 0, 1));
  EXPECT_NEAR(sample_texture(texture, 0, 0, true)[1], srgb_decode(0.2F), 1e-6);
}

TEST(Texture, RowsBeginAtTheTop) {
  static const std::array<std::uint8_t, 2> kBytes{255, 0};
  Texture texture = ramp(Wrap::clamp_to_edge);
  texture.width = 1;
  texture.height = 2;
  texture.channels = 1;
  texture.pixels = std::as_bytes(std::span(kBytes));
  EXPECT_EQ(red(texture, 0.5F, 0.1F), 1);
  EXPECT_EQ(red(texture, 0.5F, 0.9F), 0);
}

TEST(Texture, CoordinatesMayBeAnything) {
  for (const float u : {std::numeric_limits<float>::quiet_NaN(), 1e30F,
                        -std::numeric_limits<float>::infinity(), 3e9F}) {
    EXPECT_EQ(red(ramp(Wrap::repeat, Filter::linear), u, 1e38F), 0);
  }
}

TEST(Texture, AMissingOneIsMarkedInColoursOnly) {
  Texture texture;
  texture.missing = true;
  EXPECT_GT(sample_texture(texture, 0.01F, 0.01F, true)[0], 0.5F);
  EXPECT_LT(sample_texture(texture, 0.13F, 0.01F, true)[0], 0.1F);
  EXPECT_THAT(sample_texture(texture, 0.01F, 0.01F, false), ElementsAre(1, 1, 1, 1));
  EXPECT_EQ(sample_channel(texture, 0, 0, 2), 1);
}

TEST(Texture, TransformsTurnAboutTheOrigin) {
  TextureUse use;
  use.transform = {{{0, 2, 0.5F}, {-2, 0, 0.25F}}};
  EXPECT_THAT(transform_uv(use, {0.25F, 0.5F}), ElementsAre(FloatEq(1.5F), FloatEq(-0.25F)));
}

}  // namespace
}  // namespace gltfx::render
