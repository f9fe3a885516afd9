// SPDX-License-Identifier: Apache-2.0
// Directions that all surfaces of a picture share.
#include "render/sky_samples.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>

#include <gtest/gtest.h>

#include "base/packed.hpp"
#include "preview/lighting.hpp"
#include "render/sampler.hpp"
#include "studio_stage.hpp"

namespace gltfx::render {
namespace {

constexpr std::uint32_t kFew = 32;  // samples of a pixel

const EnvironmentImage& studio() {
  static const EnvironmentImage kImage =
      preview::studio_environment(normalize(Vec3d(0.5, 0.3, 0.8)));
  return kImage;
}

// The irradiance of a side, or of both together, by choices among the directions.
Rgb estimate(const SkySamples& sky, const Receiver& receiver) {
  constexpr std::uint32_t kChoices = 1U << 14U;
  Rgb sum;
  for (std::uint32_t i = 0; i < kChoices; ++i) {
    const EnvironmentSample light = sky.choose(receiver, SampleStream(1, 2, i).pair(0));
    if (!(light.pdf > 0)) continue;
    const double cosine = dot(light.direction, receiver.normal);
    EXPECT_TRUE(receiver.behind > 0 || cosine > 0);
    sum += light.radiance * (std::fabs(cosine) * light.scale / kChoices);
  }
  return sum;
}

TEST(SkySamples, GiveTheIrradianceOfEachNormal) {
  const SkySamples sky{Environment(studio()), kFew};
  for (const Vec3d& normal : {Vec3d(0, 1, 0), Vec3d(0, -1, 0), normalize(Vec3d(1, 0.2, -2)),
                              normalize(Vec3d(-0.3, 0.8, 0.4))}) {
    const Rgb front = preview::irradiance(studio(), normal);
    const Rgb back = preview::irradiance(studio(), -normal);
    EXPECT_NEAR(luminance(estimate(sky, {normal})), luminance(front), 0.005 * luminance(front));
    EXPECT_NEAR(luminance(estimate(sky, {normal, 0.3})), luminance(front + back),
                0.005 * luminance(front + back));
  }
}

// A picture by shared directions is that by directions of each surface's own.
TEST(SkySamples, LightAStageAlike) {
  Stage exact = studio_stage();
  Stage shared = studio_stage();
  shared.world.sky.emplace(*shared.world.environment, kFew);
  for (const Vec3d& towards : {Vec3d(0, -0.1, -6), Vec3d(0.7, -0.3, -6), Vec3d(-1.2, -1, -6)}) {
    const Ray ray{front().origin, normalize(towards)};
    const Estimate one = exact.path(ray, 8000);
    const Estimate other = shared.path(ray, 8000);
    for (int c = 0; c < 3; ++c) {
      EXPECT_NEAR(other.mean[c], one.mean[c],
                  3.5 * (one.error[c] + other.error[c]) + 0.004 * one.mean[c]);
    }
    // Gloss is found by paths, which are as noisy with both.
    EXPECT_LT(other.error.x, 0.96 * one.error.x) << "and with less noise";
  }
}

// The variance of sums of `choices` choices, of which point(sum, i) gives the numbers. Only the
// sky around a direction is not occluded.
template <class Point>
double variance_of_sums(const Vec3d& open, std::uint32_t choices, const Point& point) {
  static const SkySamples kSky{Environment(studio()), kFew};
  constexpr std::uint32_t kSums = 2000;
  double total = 0;
  double squares = 0;
  for (std::uint32_t each = 0; each < kSums; ++each) {
    double sum = 0;
    for (std::uint32_t i = 0; i < choices; ++i) {
      const EnvironmentSample light = kSky.choose({{0, 1, 0}}, point(each, i));
      if (dot(light.direction, open) > 0.6)
        sum += luminance(light.radiance) * light.direction.y * light.scale;
    }
    total += sum;
    squares += sum * sum;
  }
  return squares / kSums - total * total / kSums / kSums;
}

Float2 independent(std::uint32_t number) {
  return {unit_float(mix_bits(number)), unit_float(mix_bits(number, 1))};
}

TEST(SkySamples, StratifiedNumbersChooseDirectionsThatAreApart) {
  const auto variance = [](bool stratified) {
    constexpr std::uint32_t kChoices = 16;
    return variance_of_sums({0, 1, 0}, kChoices, [=](std::uint32_t sum, std::uint32_t i) {
      const auto [first, second] = independent(sum * kChoices + i);
      return Float2{first, stratified ? (static_cast<float>(i) + second) / kChoices : second};
    });
  };
  EXPECT_LT(variance(true), 0.4 * variance(false));
}

// With many numbers, those that choose the block must be stratified, too.
TEST(SkySamples, BlocksMoveThroughTheSky) {
  constexpr std::uint32_t kChoices = 128;
  const Vec3d open = normalize(Vec3d(0.6, 0.5, 0.3));
  const auto blocks_at_random = [](std::uint32_t sum, std::uint32_t i) {
    return Float2{independent(sum * kChoices + i)[0], SampleStream(1, sum, i).pair(0)[1]};
  };
  const auto stratified = [](std::uint32_t sum, std::uint32_t i) {
    return SampleStream(1, sum, i).pair(0);
  };
  EXPECT_LT(variance_of_sums(open, kChoices, stratified),
            0.85 * variance_of_sums(open, kChoices, blocks_at_random));
}

// Where the density is exact, its product with the scale of a choice is the same for all.
TEST(SkySamples, ChooseByTheDensityThatTheyGive) {
  const SkySamples sky{Environment(studio()), kFew};
  for (const Receiver& receiver :
       {Receiver{{0, 1, 0}}, Receiver{normalize(Vec3d(1, 0.2, -2))},
        Receiver{normalize(Vec3d(-0.3, 0.8, 0.4)), 0.3}, Receiver{{0, 0, 1}, 1}}) {
    const SkyPdf pdf = sky.pdf(receiver, 1);
    constexpr std::uint32_t kChoices = 4096;
    double sum = 0;
    double squares = 0;
    for (std::uint32_t i = 0; i < kChoices; ++i) {
      const EnvironmentSample light = sky.choose(receiver, SampleStream(1, 2, i).pair(0));
      ASSERT_GT(light.pdf, 0);
      const double product = pdf(light.direction, light.radiance) * light.scale;
      sum += product / kChoices;
      squares += product * product / kChoices;
    }
    EXPECT_LT(std::sqrt(squares - sum * sum), 0.3 * sum);
    EXPECT_NEAR(sum, 1, 0.1);
    EXPECT_EQ(pdf(-receiver.normal, Rgb(1)) > 0, receiver.behind > 0);
    EXPECT_EQ(pdf(receiver.normal, Rgb(1)) > 0, receiver.behind < 1);
    EXPECT_NEAR(sky.pdf(receiver, 3)(receiver.normal, Rgb(1)), 3 * pdf(receiver.normal, Rgb(1)),
                1e-9);
  }
}

// The colour is that of the lights, not only their brightness.
TEST(SkySamples, KeepColours) {
  EnvironmentImage image;
  image.width = 64;
  image.height = 32;
  image.radiance.assign(64U * 32U, {0.1F, 0.2F, 0.4F});
  image.radiance[8U * 64U + 20U] = {300, 200, 20};
  const SkySamples sky{Environment(image), kFew};
  const Vec3d normal = normalize(Vec3d(0.2, 0.9, -0.1));
  const Rgb expected = preview::irradiance(image, normal);
  const Rgb found = estimate(sky, {normal});
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(found[c], expected[c], 0.02 * expected[c]) << c;
}

TEST(SkySamples, PrefilteredIrradianceIsNear) {
  const SkySamples sky{Environment(studio()), kFew};
  const double most = luminance(preview::irradiance(studio(), normalize(Vec3d(0, 1, 0.5))));
  for (std::uint32_t i = 0; i < 64; ++i) {
    const Float2 u = SampleStream(3, 4, i).pair(0);
    const Vec3d normal = direction_of(u);
    EXPECT_NEAR(luminance(sky.irradiance(normal)), luminance(preview::irradiance(studio(), normal)),
                0.08 * most);
  }
}

// So that their error is small compared with the noise of a pixel.
TEST(SkySamples, MoreSamplesHaveMoreDirections) {
  const Environment environment(studio());
  const SkySamples best(environment, 1U << 20U);
  const auto error = [&](std::uint32_t samples) {
    const SkySamples sky(environment, samples);
    double most = 0;
    for (const Vec3d& normal : {Vec3d(0, 1, 0), Vec3d(0, 0, 1), normalize(Vec3d(-1, 0.3, 0.2))}) {
      const double exact = luminance(best.irradiance(normal));
      most = std::max(most, std::fabs(luminance(sky.irradiance(normal)) / exact - 1));
    }
    return most;
  };
  const double of_few = error(kFew);
  EXPECT_LT(of_few, 0.002);
  EXPECT_LT(error(64 * kFew), of_few / 2);
}

TEST(SkySamples, ABlackSkyGivesNoDirection) {
  EnvironmentImage image;
  image.width = image.height = 1;
  image.radiance = {{0, 0, 0}};
  const SkySamples sky{Environment(image), kFew};
  EXPECT_EQ(sky.choose({{0, 1, 0}, 0.5}, {0.5F, 0.5F}).pdf, 0);
  EXPECT_EQ(sky.irradiance({0, 1, 0}), Rgb());
}

}  // namespace
}  // namespace gltfx::render
