// SPDX-License-Identifier: Apache-2.0
/// Rough diffuse surfaces: KHR_materials_diffuse_roughness.
#include <cmath>

#include <gtest/gtest.h>

#include "random.hpp"
#include "shader/material.hpp"

namespace gltfx::shader {
namespace {

using test::Chance;
using test::direction_of_cosine;

// Diffuse light only.
Material rough_matte(const Rgb& color, double roughness) {
  Material m;
  m.metallic = 0;
  m.specular = 0;
  m.base_color = color;
  m.diffuse_roughness = roughness;
  return m;
}

// The first bounce of the model, and its albedo and the mean of that by adding up: what the paper
// has in closed form.
double first_bounce(double r, const Vec3d& v, const Vec3d& l) {
  const double s = dot(v, l) - v.z * l.z;
  return (1 + r * (s > 0 ? s / std::max(v.z, l.z) : s)) / (1 + (0.5 - 2 / (3 * pi)) * r);
}

constexpr int kRoughSteps = 128;

double albedo_of_first_bounce(double r, const Vec3d& v) {
  double sum = 0;
  for (int i = 0; i < kRoughSteps; ++i) {
    for (int j = 0; j < kRoughSteps; ++j) {
      sum +=
          first_bounce(r, v, cosine_hemisphere((i + 0.5) / kRoughSteps, (j + 0.5) / kRoughSteps));
    }
  }
  return sum / (kRoughSteps * kRoughSteps);
}

// The albedo does not depend on the azimuth.
double mean_albedo_of_first_bounce(double r) {
  double sum = 0;
  for (int i = 0; i < kRoughSteps; ++i) {
    sum += albedo_of_first_bounce(r, cosine_hemisphere((i + 0.5) / kRoughSteps, 0));
  }
  return sum / kRoughSteps;
}

TEST(DiffuseRoughness, AtZeroIsLambert) {
  Chance chance(31);
  for (int i = 0; i < 200; ++i) {
    const Rgb color = chance.color();
    const Vec3d v = chance.upwards();
    const Directions d(v, chance.anywhere());
    EXPECT_EQ(rough_diffuse_brdf(color, 0, v).eval(d, {}), diffuse_brdf(color).eval(d, {}));
    const Rgb behind = rough_diffuse_btdf(color, 0, v).eval(d, {});
    EXPECT_EQ(behind, d.opposite ? color * inv_pi : Rgb());
  }
}

TEST(DiffuseRoughness, WhiteLosesNothing) {
  for (const double roughness : {0.01, 0.3, 0.7, 1.0}) {
    for (const double cosine : {0.05, 0.3, 0.7, 1.0}) {
      EXPECT_NEAR(integrate(rough_matte(Rgb(1), roughness), direction_of_cosine(cosine)).total.x, 1,
                  2e-3)
          << "roughness " << roughness << ", cosine " << cosine;
    }
  }
}

// Little of what bounces more than once is left of dark colours.
TEST(DiffuseRoughness, DarkColorsReflectTheFirstBounce) {
  constexpr double kDark = 1e-4;
  for (const double roughness : {0.3, 1.0}) {
    for (const double cosine : {0.3, 0.8}) {
      const Vec3d v = direction_of_cosine(cosine);
      const double albedo = integrate(rough_matte(Rgb(kDark), roughness), v).total.x;
      EXPECT_NEAR(albedo / kDark, albedo_of_first_bounce(roughness, v), 1e-3);
    }
  }
}

TEST(DiffuseRoughness, ValuesAreThoseOfTheModel) {
  Chance chance(32);
  const double r = 0.75;
  const double mean_albedo = mean_albedo_of_first_bounce(r);
  for (int i = 0; i < 20; ++i) {
    const Vec3d v = direction_of_cosine(chance.between(0.2, 1));
    const Vec3d l = chance.upwards();
    const double rho = chance.number();
    const double lost = (1 - albedo_of_first_bounce(r, v)) * (1 - albedo_of_first_bounce(r, l));
    const double again =
        rho * rho * mean_albedo / (1 - rho * (1 - mean_albedo)) * lost / (1 - mean_albedo);
    EXPECT_NEAR(evaluate(rough_matte(Rgb(rho), r), v, l).x * pi,
                rho * first_bounce(r, v, l) + again, 2e-3);
  }
}

TEST(DiffuseRoughness, FlattensTheShading) {
  const Vec3d v = direction_of_cosine(0.4);
  const Material smooth = rough_matte(Rgb(0.5), 0);
  const Material rough = rough_matte(Rgb(0.5), 1);
  EXPECT_GT(evaluate(rough, v, v).x, 1.3 * evaluate(smooth, v, v).x) << "towards the light";
  const Vec3d across(-v.x, -v.y, v.z);
  EXPECT_LT(evaluate(rough, v, across).x, 0.8 * evaluate(smooth, v, across).x);
}

TEST(DiffuseRoughness, BothFacesOfALeafAreRough) {
  Material leaf = rough_matte(Rgb(0.5), 0.9);
  leaf.diffuse_transmission_color = Rgb(0.5);
  leaf.diffuse_transmission = 1;
  const Vec3d v = direction_of_cosine(0.4);
  const Vec3d l = direction_of_cosine(0.7);
  const double through = evaluate(leaf, v, mirrored(l)).x;
  leaf.diffuse_transmission = 0;
  EXPECT_NEAR(through, evaluate(leaf, v, l).x, 1e-12);
}

TEST(DiffuseRoughness, IsReciprocal) {
  Chance chance(33);
  for (int i = 0; i < 100; ++i) {
    const Material m = rough_matte(chance.color(), chance.number());
    const Vec3d v = chance.upwards();
    const Vec3d l = chance.upwards();
    EXPECT_NEAR(evaluate(m, v, l).y, evaluate(m, l, v).y, 1e-12);
  }
}

TEST(DiffuseRoughness, TheConservingModeNeverGainsBelowAnInterface) {
  for (const double roughness : {0.0, 0.2, 0.6, 1.0}) {
    for (const double ior : {1.1, 1.5, 2.5}) {
      for (const double rough_base : {0.2, 0.6, 1.0}) {
        Material m = rough_matte(Rgb(1), rough_base);
        m.specular = 1;
        m.roughness = roughness;
        m.ior = ior;
        for (const double cosine : {0.02, 0.1, 0.35, 0.7, 1.0}) {
          EXPECT_LE(integrate(m, direction_of_cosine(cosine)).total.x, 1.001)
              << "roughness " << roughness << ", ior " << ior << ", of the base " << rough_base
              << ", cosine " << cosine;
        }
      }
    }
  }
}

}  // namespace
}  // namespace gltfx::shader
