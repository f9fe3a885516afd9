// SPDX-License-Identifier: Apache-2.0
#include "shader/medium.hpp"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "random.hpp"
#include "shader/directions.hpp"
#include "transfer.hpp"

namespace gltfx::shader {
namespace {

using test::Chance;

Material volume() {
  Material m;
  m.thickness = 1;
  m.attenuation_color = {0.5, 0.25, 1};
  m.attenuation_distance = 2;
  return m;
}

TEST(Medium, AttenuationFollowsBeer) {
  const Medium medium = medium_of(volume());
  EXPECT_FALSE(medium.scatters());
  EXPECT_NEAR(medium.absorption.x, std::log(2) / 2, 1e-12);
  EXPECT_NEAR(medium.transmittance(2).x, 0.5, 1e-12);
  EXPECT_NEAR(medium.transmittance(4).y, 0.0625, 1e-12);
  EXPECT_EQ(medium.transmittance(std::numeric_limits<double>::infinity()), Rgb(0, 0, 1));
  EXPECT_EQ(medium_of(Material()).extinction(), Rgb());
}

TEST(Medium, ScatterDistanceAddsToAbsorption) {
  Material m = volume();
  m.scattering = Scattering::distance;
  EXPECT_FALSE(medium_of(m).scatters()) << "an infinite distance is no scattering";
  m.scatter_distance = 0.5;
  m.scatter_color = {std::exp(-1), 1, 0};
  const Medium medium = medium_of(m);
  EXPECT_NEAR(medium.scattering.x, 2, 1e-12);
  EXPECT_EQ(medium.scattering.y, 0);
  EXPECT_TRUE(std::isfinite(medium.scattering.z)) << "black would be infinitely dense";
  EXPECT_NEAR(medium.absorption.x, std::log(2) / 2, 1e-12);
  EXPECT_EQ(medium.anisotropy, 0);
}

TEST(Medium, MultiScatterColorSharesTheAttenuation) {
  Material m = volume();
  m.scattering = Scattering::multiscatter;
  m.scatter_color = {0.5, 0, 1};
  m.scatter_anisotropy = 0.3;
  const Medium medium = medium_of(m);
  EXPECT_NEAR(medium.extinction().x, std::log(2) / 2, 1e-12);
  EXPECT_NEAR(medium.scattering.x / medium.extinction().x, single_scatter_albedo(0.5), 1e-12);
  EXPECT_EQ(medium.scattering.y, 0);
  EXPECT_EQ(medium.anisotropy, 0.3);
}

TEST(Medium, StrengthScalesTheAlbedoBeforeItIsMapped) {
  Material m = volume();
  m.scattering = Scattering::unified;
  m.scatter_color = Rgb(0.8);
  m.scatter_anisotropy = 0.4;
  m.scatter_strength = 0;
  EXPECT_FALSE(medium_of(m).scatters());
  m.scatter_strength = 0.5;
  const Medium medium = medium_of(m);
  EXPECT_NEAR(medium.scattering.x / medium.extinction().x, single_scatter_albedo(0.4, 0.4), 1e-12);
}

TEST(Medium, TheAlbedoOfManyBouncesIsMapped) {
  // The fit starts at 0 and ends at 1, and is steep: a grey of half needs nine tenths.
  EXPECT_NEAR(single_scatter_albedo(0), 0, 1e-5);
  EXPECT_NEAR(single_scatter_albedo(1), 1, 1e-5);
  EXPECT_NEAR(single_scatter_albedo(0.5), 0.91, 0.01);
  EXPECT_GT(single_scatter_albedo(0.5, 0.5), single_scatter_albedo(0.5));
}

TEST(PhaseFunction, IsADensityWithItsMeanCosine) {
  for (const double g : {-0.8, -0.2, 0.0, 0.4, 0.9}) {
    double sum = 0;
    double mean = 0;
    constexpr int kSteps = 20000;
    for (int i = 0; i < kSteps; ++i) {
      const double onwards = 2 * (i + 0.5) / kSteps - 1;  // cosine between old and new direction
      const double share = henyey_greenstein(g, -onwards) * 4 * pi / kSteps;
      sum += share;
      mean += share * onwards;
    }
    EXPECT_NEAR(sum, 1, 1e-4) << g;
    EXPECT_NEAR(mean, g, 1e-4) << g;
  }
}

TEST(PhaseFunction, DirectionsAreTakenWithItsDensity) {
  Chance chance(41);
  for (const double g : {-0.7, 0.0, 1e-7, 0.5}) {
    Medium medium;
    medium.anisotropy = g;
    constexpr int kSamples = 40000;
    for (const Vec3d& along : {Vec3d(0, 0, 1), Vec3d(0.6, 0, -0.8), Vec3d(0, 0, -1)}) {
      int backwards = 0;
      Vec3d sum;
      for (int i = 0; i < kSamples; ++i) {
        const Vec3d l = sample_phase(medium, along, chance.number(), chance.number());
        ASSERT_NEAR(dot(l, l), 1, 1e-9);
        backwards += dot(l, along) < 0 ? 1 : 0;
        sum += l;
      }
      const Vec3d mean = sum / kSamples;
      EXPECT_NEAR(dot(mean, along), g, 0.015);
      EXPECT_NEAR(std::sqrt(dot(cross(mean, along), cross(mean, along))), 0, 0.015);
      double expected = 0.5;  // of the integral over the back hemisphere
      if (g != 0) expected = (1 - g * g) / (2 * g) * (1 / std::sqrt(1 + g * g) - 1 / (1 + g));
      EXPECT_NEAR(backwards / static_cast<double>(kSamples), expected, 0.015) << g;
    }
  }
}

// A random walk in a half space.
TEST(PhaseFunction, AWalkComesBackAsOftenAsTransferTheorySays) {
  Chance chance(42);
  for (const double w : {0.5, 0.9}) {
    const double mu = 0.6;
    constexpr int kPaths = 30000;
    double sum = 0;
    for (int i = 0; i < kPaths; ++i) {
      Vec3d onwards(0.8, 0, -mu);
      double depth = 0;
      double weight = 1;
      while (weight > 1e-4) {
        depth -= onwards.z * -std::log(1 - chance.number());
        if (depth < 0) break;
        weight *= w;
        onwards = sample_phase({}, onwards, chance.number(), chance.number());
      }
      if (depth < 0) sum += weight;
    }
    EXPECT_NEAR(sum / kPaths, plane_albedo(w, mu), 0.008) << w;
  }
}

}  // namespace
}  // namespace gltfx::shader
