// SPDX-License-Identifier: Apache-2.0
#include "render/environment.hpp"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "base/packed.hpp"
#include "preview/lighting.hpp"
#include "render/sampler.hpp"
#include "shader/sin_cos.hpp"

namespace gltfx::render {
namespace {

// Dark, except for a bright spot and one texel beside it.
EnvironmentImage spotted() {
  EnvironmentImage image;
  image.width = 32;
  image.height = 16;
  image.radiance.assign(512, {0, 0, 0});
  image.radiance[5 * 32 + 20] = {50, 40, 30};
  image.radiance[12 * 32 + 0] = {0, 9, 0};
  return image;
}

TEST(Environment, DirectionsAndPointsOfTheImageBelongTogether) {
  EXPECT_NEAR(direction_of({0.5F, 0.5F}).z, -1, 1e-6) << "the middle looks along -z";
  EXPECT_NEAR(direction_of({0.75F, 0.5F}).x, 1, 1e-6) << "right of it lies +x";
  EXPECT_NEAR(direction_of({0.3F, 0.0F}).y, 1, 1e-6) << "the upper edge is up";
  for (std::uint32_t i = 0; i < 200; ++i) {
    const Float2 point = SampleStream(0, 0, i).pair(0);
    const Float2 back = point_of(direction_of(point));
    EXPECT_NEAR(back[0], point[0], 1e-5F);
    EXPECT_NEAR(back[1], point[1], 1e-5F);
  }
}

TEST(Environment, TurnsAreSinesAndCosines) {
  for (double turns = -1; turns <= 1; turns += 0.00137) {
    const shader::SinCos turn = shader::sin_cos_of(turns);
    EXPECT_NEAR(turn.sine, std::sin(turns * 2 * std::numbers::pi), 4e-9) << turns;
    EXPECT_NEAR(turn.cosine, std::cos(turns * 2 * std::numbers::pi), 4e-9) << turns;
  }
}

TEST(Environment, AnglesComeBackFromTheirSinesAndCosines) {
  for (double turns = -0.4999; turns < 0.5; turns += 0.00137) {
    const shader::SinCos turn = shader::sin_cos_of(turns);
    EXPECT_NEAR(shader::turn_of(3 * turn.sine, 3 * turn.cosine), turns, 5e-7);
  }
  EXPECT_EQ(shader::turn_of(0, 0), 0);
}

TEST(Environment, RadianceIsReadBetweenTexels) {
  const Environment environment(spotted());
  const Vec3d middle = direction_of({20.5F / 32, 5.5F / 16});
  EXPECT_NEAR(environment.radiance(middle).x, 50, 1e-3);
  const Vec3d half = direction_of({21.0F / 32, 5.5F / 16});
  EXPECT_NEAR(environment.radiance(half).x, 25, 1e-3);
  const Vec3d seam = direction_of({1.0F, 12.5F / 16});
  EXPECT_NEAR(environment.radiance(seam).y, 4.5, 1e-3) << "the image closes around";
}

// The density of samples is the returned one, cell by cell.
TEST(Environment, SamplesFollowTheirDensity) {
  const Environment environment(spotted());
  constexpr std::uint32_t kSamples = 4096;
  std::array<double, 512> found{};
  std::array<double, 512> expected{};
  const auto cell = [](const Float2& p) {
    return static_cast<std::size_t>(p[1] * 16) * 32 + static_cast<std::size_t>(p[0] * 32);
  };
  for (std::uint32_t i = 0; i < kSamples; ++i) {
    const EnvironmentSample sample = environment.sample(SampleStream(1, 2, i).pair(0));
    ASSERT_GT(sample.pdf, 0);
    EXPECT_NEAR(sample.radiance.x, environment.radiance(sample.direction).x, 1e-2);
    EXPECT_NEAR(sample.pdf, environment.pdf(sample.direction), 0.01 * sample.pdf);
    found[cell(point_of(sample.direction))] += 1.0 / kSamples;
  }
  double total = 0;
  constexpr int kFine = 4;
  for (int y = 0; y < 16 * kFine; ++y) {
    for (int x = 0; x < 32 * kFine; ++x) {
      const Float2 p{(static_cast<float>(x) + 0.5F) / (32 * kFine),
                     (static_cast<float>(y) + 0.5F) / (16 * kFine)};
      const double solid = 2 * std::numbers::pi * std::numbers::pi *
                           std::sin(std::numbers::pi * static_cast<double>(p[1])) /
                           (512.0 * kFine * kFine);
      const double share = environment.pdf(direction_of(p)) * solid;
      expected[cell(p)] += share;
      total += share;
    }
  }
  EXPECT_NEAR(total, 1, 1e-3);
  for (std::size_t i = 0; i < 512; ++i) EXPECT_NEAR(found[i], expected[i], 0.004) << i;
}

TEST(Environment, WhatIsNotBlackIsSampled) {
  const Environment environment(spotted());
  for (float x = 0.01F; x < 1; x += 0.013F) {
    for (float y = 0.01F; y < 1; y += 0.017F) {
      const Vec3d direction = direction_of({x, y});
      if (max_value(environment.radiance(direction)) > 0.01) {
        EXPECT_GT(environment.pdf(direction), 0) << x << " " << y;
      }
    }
  }
}

TEST(Environment, ABlackOneHasNoBrightestPart) {
  EnvironmentImage image;
  image.width = image.height = 1;
  image.radiance = {{0, 0, 0}};
  const Environment environment(image);
  EXPECT_GT(environment.sample({0.5F, 0.25F}).pdf, 0);
  EXPECT_EQ(environment.radiance({0, 1, 0}), Rgb());
}

TEST(Studio, AWhiteSurfaceComesOutBelowWhite) {
  const Vec3d backward = normalize(Vec3d(0.5, 0.3, 0.8));
  const Environment studio(preview::studio_environment(backward));
  Rgb sum;
  constexpr std::uint32_t kSamples = 4096;
  for (std::uint32_t i = 0; i < kSamples; ++i) {
    const EnvironmentSample light = studio.sample(SampleStream(3, 1, i).pair(0));
    const double cosine = dot(light.direction, backward);
    if (cosine > 0) sum += light.radiance * (cosine / light.pdf / std::numbers::pi / kSamples);
  }
  EXPECT_GT(luminance(sum), 0.6);
  EXPECT_LT(luminance(sum), 1.1);
}

}  // namespace
}  // namespace gltfx::render
