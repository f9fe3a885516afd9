// SPDX-License-Identifier: Apache-2.0
#include "render/tone_curve.hpp"

#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "render/tonemap.hpp"

namespace gltfx::render {
namespace {

using testing::AllOf;
using testing::Each;
using testing::ElementsAre;
using testing::FloatNear;
using testing::Ge;
using testing::Le;
using testing::Pointwise;

constexpr ToneCurve kCurves[] = {ToneCurve::neutral, ToneCurve::aces, ToneCurve::agx,
                                 ToneCurve::none};

TEST(ToneCurve, NeutralIsTheUsualOne) {
  for (const Float3 light : {Float3{0.1F, 0.4F, 0.7F}, Float3{3, 1, 0.2F}}) {
    EXPECT_EQ(tone_map(light, ToneCurve::neutral), tone_map(light));
  }
}

TEST(ToneCurve, NoneClips) {
  EXPECT_THAT(tone_map({0.25F, 1.5F, -1}, ToneCurve::none), ElementsAre(0.25F, 1, 0));
}

// References computed in double precision from the publications that tone_curve.cpp names.
TEST(ToneCurve, AcesAndAgxHaveThePublishedValues) {
  const auto near = [](float expected) { return FloatNear(expected, 2e-4F); };
  EXPECT_THAT(tone_map({0.18F, 0.18F, 0.18F}, ToneCurve::aces),
              ElementsAre(near(0.21311F), near(0.21311F), near(0.21310F)));
  EXPECT_THAT(tone_map({0.8F, 0.2F, 0.05F}, ToneCurve::aces),
              ElementsAre(near(0.78140F), near(0.27480F), near(0.06441F)));
  EXPECT_THAT(tone_map({0.18F, 0.18F, 0.18F}, ToneCurve::agx),
              ElementsAre(near(0.21455F), near(0.21450F), near(0.21450F)));
  EXPECT_THAT(tone_map({0.8F, 0.2F, 0.05F}, ToneCurve::agx),
              ElementsAre(near(0.58460F), near(0.25171F), near(0.12293F)));
}

TEST(ToneCurve, EachStaysGreyAndGrowsWithTheLight) {
  for (const ToneCurve curve : kCurves) {
    float last = -1;
    for (const float light : {0.0F, 0.01F, 0.18F, 0.5F, 1.0F, 4.0F, 16.0F, 1e6F}) {
      const Float3 shown = tone_map({light, light, light}, curve);
      EXPECT_THAT(shown, Each(AllOf(Ge(0), Le(1))));
      EXPECT_THAT(shown, Each(FloatNear(shown[0], 3e-3F))) << static_cast<int>(curve) << light;
      EXPECT_GE(shown[0], last);
      last = shown[0];
    }
    EXPECT_GT(last, 0.98F) << "very bright light is white";
  }
}

// The distance of linear light from grey, and its hue in degrees.
std::pair<double, double> chroma_and_hue(const Float3& c) {
  const double x = 2 * static_cast<double>(c[0]) - static_cast<double>(c[1] + c[2]);
  const double y = std::sqrt(3.0) * static_cast<double>(c[1] - c[2]);
  return {std::hypot(x, y) / 2, std::atan2(y, x) * 180 / std::numbers::pi};
}

// What docs/bake.md says of them: only a lower exposure keeps the color of such light.
TEST(ToneCurve, VeryBrightColorsTurnWhiteWithTheirHueOrAnother) {
  const auto turn = [](ToneCurve curve, float strength, const Float3& color) {
    const Float3 bright{color[0] * strength, color[1] * strength, color[2] * strength};
    const auto [chroma, hue] = chroma_and_hue(tone_map(bright, curve));
    if (strength >= 20) {
      EXPECT_LT(chroma, 0.3) << "nearly white";
    }
    return std::fabs(std::remainder(hue - chroma_and_hue(color).second, 360));
  };
  for (const float strength : {2.0F, 4.0F, 20.0F}) {
    for (const Float3& color : {Float3{1, 0.02F, 0.02F}, Float3{1, 0.35F, 0.02F}}) {
      const double neutral = turn(ToneCurve::neutral, strength, color);
      const double agx = turn(ToneCurve::agx, strength, color);
      EXPECT_LT(neutral, 1);
      EXPECT_LT(agx, turn(ToneCurve::aces, strength, color));
      EXPECT_LT(agx, 25);
    }
  }
}

TEST(ToneCurve, WhatIsNoNumberIsBlack) {
  const float none = std::numeric_limits<float>::quiet_NaN();
  for (const ToneCurve curve : kCurves) {
    const Float3 black = tone_map({0, 0, 0}, curve);
    EXPECT_THAT(black, Each(FloatNear(0, 1e-3F)));
    EXPECT_EQ(tone_map({none, -1, none}, curve), black);
  }
}

}  // namespace
}  // namespace gltfx::render
