// SPDX-License-Identifier: Apache-2.0
#include "render/tonemap.hpp"

#include <cmath>
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace gltfx::render {
namespace {

using testing::Each;
using testing::ElementsAre;
using testing::FloatNear;

TEST(ToneMap, ColoursOfUsualBrightnessLoseTheirReflectionOnly) {
  EXPECT_THAT(
      tone_map({0.3F, 0.4F, 0.5F}),
      ElementsAre(FloatNear(0.26F, 1e-6F), FloatNear(0.36F, 1e-6F), FloatNear(0.46F, 1e-6F)));
  EXPECT_THAT(tone_map({0, 0, 0}), Each(0));
  EXPECT_THAT(tone_map({0.04F, 0.04F, 0.04F}), Each(FloatNear(0.01F, 1e-6F)));
}

TEST(ToneMap, BrightnessNearsWhiteWithoutReachingIt) {
  float last = 0;
  for (const float value : {0.5F, 0.8F, 1.0F, 2.0F, 8.0F, 100.0F}) {
    const Float3 mapped = tone_map({value, value, value});
    EXPECT_GT(mapped[0], last);
    EXPECT_LT(mapped[0], 1);
    last = mapped[0];
  }
  const Float3 red = tone_map({100, 0, 0});
  EXPECT_GT(red[1], 0.8F) << "bright colours turn white";
}

TEST(ToneMap, WhatIsNoNumberIsBlack) {
  const float none = std::numeric_limits<float>::quiet_NaN();
  EXPECT_THAT(tone_map({none, -1, none}), Each(0));
}

TEST(Srgb, ThereAndBack) {
  for (int i = 0; i < 256; ++i) {
    const auto byte = static_cast<std::uint8_t>(i);
    EXPECT_EQ(to_byte(srgb_encode(srgb_decode_byte(byte))), byte);
  }
  EXPECT_NEAR(srgb_decode(0.5F), 0.21404114F, 1e-6F);
  EXPECT_EQ(to_byte(2), 255);
  EXPECT_EQ(to_byte(-1), 0);
}

}  // namespace
}  // namespace gltfx::render
