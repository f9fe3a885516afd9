// SPDX-License-Identifier: Apache-2.0
#include "render/sample_map.hpp"

#include <algorithm>
#include <cstdint>
#include <utility>

#include <gtest/gtest.h>

#include "render/render.hpp"
#include "studio_stage.hpp"

namespace gltfx::render {
namespace {

RenderOptions small_adaptive(std::uint32_t samples) {
  RenderOptions options;
  options.width = 50;  // no multiple of anything
  options.height = 39;
  options.samples = samples;
  return options;
}

template <class Visit>
void for_pixels(const RenderOptions& options, const Visit& visit) {
  for (std::uint32_t y = 0; y < options.height; ++y) {
    for (std::uint32_t x = 0; x < options.width; ++x) visit(x, y);
  }
}

void expect_equal(const SampleMap& one, const SampleMap& other, const RenderOptions& options) {
  for_pixels(options, [&](std::uint32_t x, std::uint32_t y) {
    ASSERT_EQ(one.samples(x, y), other.samples(x, y));
  });
}

TEST(SampleMap, SharesOutWhatThereIs) {
  const Stage stage = studio_stage();
  for (const std::uint32_t samples : {16U, 20U, 33U, 64U}) {
    const RenderOptions options = small_adaptive(samples);
    const SampleMap shares(stage.context(), front(), options);
    double sum = 0;
    std::uint32_t least = samples;
    std::uint32_t most = samples;
    for_pixels(options, [&](std::uint32_t x, std::uint32_t y) {
      const std::uint32_t count = shares.samples(x, y);
      sum += count;
      least = std::min(least, count);
      most = std::max(most, count);
    });
    const double mean = sum / (options.width * options.height);
    EXPECT_LE(mean, samples);
    EXPECT_GT(mean, 0.9 * samples);
    EXPECT_GE(least, samples / 10);
    EXPECT_LE(most, samples * 4);
    EXPECT_EQ(most, shares.most());
    EXPECT_LT(2 * least, most);
  }
}

// The average of 32 samples by `deviation`, under the sky.
double mean_under_sky(double deviation, double transmission = 0) {
  Stage stage = studio_stage(transmission);
  stage.world.sky.emplace(*stage.world.environment, 32);
  RenderOptions options = small_adaptive(32);
  options.deviation = deviation;
  const SampleMap shares(stage.context(), front(), options);
  double sum = 0;
  for_pixels(options, [&](std::uint32_t x, std::uint32_t y) { sum += shares.samples(x, y); });
  return sum / (options.width * options.height);
}

// Fewer samples for less noise; the deviation sets the scale.
TEST(SampleMap, QuietPicturesGetLess) {
  const double all = mean_under_sky(0);
  EXPECT_EQ(mean_under_sky(1e-6), all) << "all is noise";
  EXPECT_NEAR(mean_under_sky(1), 11, 1) << "none is";
  const double between = mean_under_sky(0.05);
  EXPECT_GT(between, 22);
  EXPECT_LT(between, all - 2);
}

// The denoiser has no features of objects behind a surface.
TEST(SampleMap, TransmissionTakesMore) { EXPECT_NEAR(mean_under_sky(1, 0.5), 14, 1); }

TEST(SampleMap, WithoutASkyNoneAreSaved) {
  const Stage stage = studio_stage();
  RenderOptions options = small_adaptive(32);
  const SampleMap all(stage.context(), front(), options);
  options.deviation = 1;
  expect_equal(SampleMap(stage.context(), front(), options), all, options);
}

TEST(SampleMap, NoiseGetsMore) {
  const Stage stage = studio_stage();
  const RenderOptions options = small_adaptive(32);
  const SampleMap shares(stage.context(), front(), options);
  EXPECT_EQ(shares.samples(1, 1), 4U) << "the backdrop, which has none";
  EXPECT_GT(shares.samples(25, 20), 16U) << "the ball";
}

// Features do not see through glass: objects behind it count as noise.
TEST(SampleMap, EdgesBehindGlassGetMore) {
  const auto at_edge = [](double transmission) {
    Scene scene = scene_of(quad(), matte(Rgb(1)));
    scene.materials[0].factors.unlit = true;
    scene.materials.push_back(matte(Rgb(1)));
    scene.materials[1].factors.transmission = transmission;
    scene.materials[1].factors.roughness = 0;
    scene.meshes.push_back(quad());
    scene.meshes[1].material = 1;
    scene.instances.push_back({1, moved(0, 0, 1, 8)});
    const Stage stage(std::move(scene));
    const RenderOptions options = small_adaptive(32);
    return SampleMap(stage.context(), front(), options).samples(16, 16);
  };
  EXPECT_EQ(at_edge(0), 4U) << "nothing is seen through it";
  EXPECT_GT(at_edge(1), 32U);
}

TEST(SampleMap, TheNumberOfThreadsDoesNotShow) {
  const Stage stage = studio_stage();
  RenderOptions options = small_adaptive(16);
  const SampleMap one(stage.context(), front(), options);
  options.jobs = 2;
  expect_equal(SampleMap(stage.context(), front(), options), one, options);
}

// Nothing but an even backdrop.
TEST(SampleMap, WithoutNoiseFewAreEnough) {
  Stage stage(scene_of(quad(), matte(Rgb(0.5))));
  View away;
  away.origin = {0, 0, 4};
  away.backward = {0, 0, -1};
  const RenderOptions options = small_adaptive(16);
  const SampleMap shares(stage.context(), away, options);
  EXPECT_EQ(shares.most(), 2U);
}

TEST(SampleMap, FewSamplesOrAnEndOfTheirOwnAreTheSameEverywhere) {
  const Stage stage = studio_stage();
  const auto expect_even = [&stage](const RenderOptions& options) {
    const SampleMap shares(stage.context(), front(), options);
    for_pixels(options, [&](std::uint32_t x, std::uint32_t y) {
      ASSERT_EQ(shares.samples(x, y), options.samples);
    });
  };
  expect_even(small_adaptive(15));
  RenderOptions options = small_adaptive(64);
  options.seconds = 10;
  expect_even(options);
  options.seconds = 0;
  options.noise = 0.01;
  expect_even(options);
}

}  // namespace
}  // namespace gltfx::render
