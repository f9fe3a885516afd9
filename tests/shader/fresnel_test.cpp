// SPDX-License-Identifier: Apache-2.0
#include "shader/fresnel.hpp"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace gltfx::shader {
namespace {

Material smooth_glass() {
  Material m;
  m.metallic = 0;
  return m;
}

TEST(Fresnel, F0ComesFromTheIor) {
  EXPECT_NEAR(dielectric_fresnel(smooth_glass(), 1, ShaderMode::spec).at(1).x, 0.04, 1e-12);
  Material diamond = smooth_glass();
  diamond.ior = 2.42;
  EXPECT_NEAR(dielectric_fresnel(diamond, 1, ShaderMode::spec).at(1).x, square(1.42 / 3.42), 1e-12);
  EXPECT_NEAR(dielectric_fresnel(diamond, 1, ShaderMode::spec).at(0).x, 1, 1e-12);
  diamond.outside_ior = 2.42;
  EXPECT_EQ(dielectric_fresnel(diamond, 1, ShaderMode::spec).at(1).x, 0);
}

TEST(Fresnel, SpecularColorIsCutOffBeforeTheFactorScalesIt) {
  Material m = smooth_glass();
  m.specular_color = {50, 1, 0};
  m.specular = 0.5;
  const Fresnel fresnel = dielectric_fresnel(m, 1, ShaderMode::spec);
  EXPECT_NEAR(fresnel.at(1).x, 0.5, 1e-12);
  EXPECT_NEAR(fresnel.at(1).y, 0.02, 1e-12);
  EXPECT_NEAR(fresnel.at(1).z, 0, 1e-12);
  EXPECT_NEAR(fresnel.at(0).z, 0.5, 1e-12);
}

TEST(Fresnel, AnIorOfZeroIsInfinite) {
  Material m = smooth_glass();
  m.ior = 0;
  for (const double cosine : {0.0, 0.4, 1.0}) {
    EXPECT_EQ(dielectric_fresnel(m, 1, ShaderMode::spec).at(cosine), Rgb(1));
  }
}

TEST(Fresnel, InsideTheCurveBelongsToTheAngleOutside) {
  Material m = smooth_glass();
  m.specular = 0.3;
  const Fresnel inside = dielectric_fresnel(m, 1 / 1.5, ShaderMode::spec);
  const Fresnel outside = dielectric_fresnel(m, 1.5, ShaderMode::spec);
  const double sine = 0.5;  // inside; outside it is 0.75
  const double cosine = std::sqrt(1 - square(sine));
  EXPECT_NEAR(inside.at(cosine).x, outside.at(std::sqrt(1 - square(0.75))).x, 1e-12);
  EXPECT_EQ(inside.at(0.6), Rgb(1)) << "total reflection does not ask for the specular factor";
}

TEST(Film, WithoutContrastToTheBaseItReflectsAsTheFilm) {
  // The base has the film's IOR: no interference except for the code's lower bound.
  const double f0 = f0_of_ior(1.3, 1) - 0.0001;
  for (const double thickness : {100.0, 450.0}) {
    const Rgb f = iridescent_fresnel(1, 1.3, Rgb(f0), thickness, 1);
    EXPECT_NEAR(f.x, f0_of_ior(1.3, 1), 0.01);
    EXPECT_NEAR(f.y, f0_of_ior(1.3, 1), 0.01);
  }
}

TEST(Film, ThickFilmsLoseTheirColors) {
  const Rgb thin = iridescent_fresnel(1, 1.8, Rgb(0.04), 300, 1);
  const Rgb thick = iridescent_fresnel(1, 1.8, Rgb(0.04), 20000, 1);
  EXPECT_GT(std::fabs(thin.x - thin.y), 0.05);
  EXPECT_LT(std::fabs(thick.x - thick.y), 1e-3);
}

TEST(Film, AWhiteBaseStaysFinite) {
  for (const double f0 : {0.9998, 0.9999, 1.0}) {
    const Rgb f = iridescent_fresnel(1, 1.3, Rgb(f0), 400, 0.7);
    EXPECT_TRUE(std::isfinite(f.x)) << f0;
    EXPECT_GT(f.x, 0.5) << f0;
  }
}

TEST(Film, StrengthMixesAndTheConservingModeEndsAtOne) {
  Material m = smooth_glass();
  m.metallic = 1;
  m.base_color = Rgb(0.99);
  m.iridescence = 1;
  m.iridescence_ior = 2;
  const Fresnel literal = metal_fresnel(m, ShaderMode::spec);
  const Fresnel bounded = metal_fresnel(m, ShaderMode::conserving);
  for (double cosine = 0.05; cosine <= 1; cosine += 0.05) {
    EXPECT_LE(max_value(bounded.at(cosine)), 1);
    EXPECT_GE(max_value(literal.at(cosine)), max_value(bounded.at(cosine)));
  }
  m.iridescence = 0;
  EXPECT_NEAR(metal_fresnel(m, ShaderMode::spec).at(1).x, 0.99, 1e-12);
}

TEST(Dispersion, SpreadsTheIndicesAroundTheMiddle) {
  const Rgb ior = dispersed_ior(1.5, 2);
  EXPECT_NEAR(ior.x, 1.475, 1e-12);
  EXPECT_NEAR(ior.y, 1.5, 1e-12);
  EXPECT_NEAR(ior.z, 1.525, 1e-12);
  EXPECT_EQ(dispersed_ior(1.05, 100).x, 1) << "no colour gets below 1";
  // The Abbe number is defined by the lines F and C.
  const double spread = dispersed_ior(1.5, 1, 486.13) - dispersed_ior(1.5, 1, 656.27);
  EXPECT_NEAR(0.5 / spread, 20, 0.05);
  EXPECT_NEAR(dispersed_ior(1.5, 1, 587.56), 1.5, 1e-4);
}

}  // namespace
}  // namespace gltfx::shader
