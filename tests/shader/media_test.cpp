// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include <gtest/gtest.h>

#include "shader/medium.hpp"

namespace gltfx::shader {
namespace {

Material clear_glass(double ior) {
  Material material;
  material.ior = ior;
  material.transmission = 1;
  material.thickness = 1;
  return material;
}

TEST(MediaStack, WhatIsEnteredLastIsLeftFirst) {
  MediaStack media;
  EXPECT_TRUE(media.empty());
  EXPECT_EQ(media.ior_around(0), 1);
  media.enter(clear_glass(1.33), 0);
  EXPECT_EQ(media.ior_around(1), 1.33);
  EXPECT_EQ(media.ior_around(0), 1) << "of the instance itself: what lies around it";
  media.enter(clear_glass(1.5), 1);
  media.leave(1);
  EXPECT_EQ(media.ior_around(5), 1.33);
  media.leave(7);
  media.leave(0);
  EXPECT_TRUE(media.empty());
}

TEST(MediaStack, HasABottom) {
  MediaStack media;
  for (std::uint32_t i = 0; i < 1000; ++i) media.enter(clear_glass(1.5), i);
  for (std::uint32_t i = 0; i < 1000; ++i) media.leave(i);
  EXPECT_TRUE(media.empty());
}

// Of light that goes through a slab without turning, and of all light scattered in a deep medium:
// both are known.
void expect_light_of_slab(const Medium& medium) {
  Rgb through;
  Rgb scattered;
  constexpr std::uint32_t kSide = 128;
  constexpr std::uint32_t kSamples = kSide * kSide;
  for (std::uint32_t i = 0; i < kSamples; ++i) {
    const Rgb throughput(1, 0.5, 0.2);
    const Float2 random{(static_cast<float>(i % kSide) + 0.5F) / kSide,
                        (static_cast<float>(i / kSide) + 0.5F) / kSide};
    const double flight = sample_distance(medium, throughput, random);
    const bool inside = flight < 0.7;
    (inside ? scattered : through) +=
        distance_weight(medium, throughput, inside ? flight : 0.7, inside);
  }
  for (int c = 0; c < 3; ++c) {
    const double extinction = medium.extinction()[c];
    const double expected = std::exp(-extinction * 0.7);
    EXPECT_NEAR(through[c] / kSamples, expected, 0.01) << c;
    EXPECT_NEAR(scattered[c] / kSamples, (1 - expected) * medium.scattering[c] / extinction, 0.01);
  }
}

TEST(Walk, WeighsAllColours) {
  Medium medium;
  medium.absorption = {0.1, 0.5, 0};
  medium.scattering = {1, 0.5, 3};
  expect_light_of_slab(medium);
}

TEST(Walk, WeighsAGreyMedium) {
  Medium medium;
  medium.absorption = {0.5, 0.25, 1.25};
  medium.scattering = {1, 1.25, 0.25};
  ASSERT_TRUE(medium.is_grey());
  expect_light_of_slab(medium);
}

TEST(Walk, OnlyDimsWhereNothingScatters) {
  Medium medium;
  medium.absorption = {1, 2, 0};
  EXPECT_TRUE(std::isinf(sample_distance(medium, {1, 1, 1}, {0.3F, 0.3F})));
  const Rgb weight = distance_weight(medium, {1, 1, 1}, 0.5, false);
  EXPECT_NEAR(weight.x, std::exp(-0.5), 1e-12);
  EXPECT_NEAR(weight.y, std::exp(-1.0), 1e-12);
  EXPECT_EQ(weight.z, 1);
}

}  // namespace
}  // namespace gltfx::shader
