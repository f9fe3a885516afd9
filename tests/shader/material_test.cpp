// SPDX-License-Identifier: Apache-2.0
/// What whole materials promise: energy, reciprocity, and which parameters have no effect when.
#include "shader/material.hpp"

#include <gtest/gtest.h>

#include "random.hpp"

namespace gltfx::shader {
namespace {

using test::Chance;
using test::direction_of_cosine;

constexpr ShaderOptions kSpec{ShaderMode::spec, -1};
constexpr ShaderOptions kConserving{};

bool near(const Rgb& a, const Rgb& b, double tolerance) {
  return std::fabs(a.x - b.x) <= tolerance && std::fabs(a.y - b.y) <= tolerance &&
         std::fabs(a.z - b.z) <= tolerance;
}

Material white() {
  Material m;
  m.metallic = 0;
  return m;
}

// Every layer that can reflect too much, each alone and all together.
Material layered(Chance& chance, int kind) {
  Material m = chance.material();
  m.base_color = m.diffuse_transmission_color = Rgb(1);
  if (chance.number() < 0.7) m.metallic = 0;
  if (chance.number() < 0.5) m.transmission = 0;
  m.roughness = chance.number() < 0.2 ? 0 : chance.number();
  const bool all = kind == 5;
  if (kind == 1 || all) {
    m.clearcoat = chance.number();
    m.clearcoat_roughness = chance.number();
    m.clearcoat_normal = normalize({chance.between(-0.2, 0.2), 0.1, 1});
  }
  if (kind == 2 || all) {
    m.sheen_color = chance.color();
    m.sheen_roughness = chance.number();
  }
  if (kind == 3 || all) {
    m.iridescence = chance.number();
    m.iridescence_thickness = chance.between(100, 700);
  }
  if (kind == 4 || all) m.anisotropy = chance.number();
  if (kind == 6) m.thickness = 1;
  return m;
}

// The example of the header.
TEST(Material, ALeafAgainstTheSun) {
  Material leaf;
  leaf.metallic = 0;
  leaf.base_color = {0.1, 0.3, 0.05};
  leaf.diffuse_transmission = 0.6;
  leaf.diffuse_transmission_color = {0.2, 0.6, 0.1};
  const Vec3d viewer{0, 0, 1};
  const Vec3d sun{0, 0.6, -0.8};
  const Rgb prepared = evaluate(leaf, viewer, sun) * (100000 * 0.8);
  // Lambert, less what the surface reflects.
  EXPECT_NEAR(prepared.y, 0.6 * 0.6 / pi * 80000, 0.06 * prepared.y);
  EXPECT_NEAR(prepared.x / prepared.y, 1.0 / 3, 1e-12);
  EXPECT_NEAR(integrate(leaf, viewer).diffuse_transmit.y, 0.36, 0.025);
  const auto next = sample(leaf, viewer, {0.5, 0.3, 0.7});
  ASSERT_TRUE(next);
  EXPECT_NEAR(next->pdf, pdf(leaf, viewer, next->l), 1e-12);
  EXPECT_EQ(emitted(leaf, viewer), Rgb());
}

TEST(Furnace, TheConservingModeNeverGains) {
  Chance chance(11);
  for (int i = 0; i < 84; ++i) {
    const int kind = i % 7;
    const Material m = layered(chance, kind);
    for (const double cosine : {0.03, 0.2, 0.6, 1.0}) {
      Vec3d v = direction_of_cosine(cosine);
      if (kind == 6 && i % 2 == 0) v.z = -v.z;
      const int resolution = kind == 6 ? 200 : 48;  // for the edge of total reflection
      EXPECT_LE(max_value(integrate(m, v, kConserving, resolution).total), 1.001)
          << "kind " << kind << ", cosine " << cosine;
    }
  }
}

// From inside of volumes, where total reflection begins at an angle that facets blur.
TEST(Furnace, TheConservingModeNeverGainsInsideOfVolumes) {
  Chance chance(12);
  for (int i = 0; i < 120; ++i) {
    Material m = white();
    m.thickness = 1;
    m.roughness = i % 5 == 0 ? 0 : chance.number();
    m.ior = chance.between(1, 2.5);
    m.specular = i % 2 == 0 ? 1 : chance.number();
    m.anisotropy = i % 3 == 0 ? chance.number() : 0;
    m.diffuse_transmission = chance.number();
    const double cosine = chance.between(-1, 0);
    EXPECT_LE(max_value(integrate(m, direction_of_cosine(cosine), kConserving, 200).total), 1.001)
        << "roughness " << m.roughness << ", ior " << m.ior << ", cosine " << cosine;
  }
}

// By albedo: the reduction at grazing angles does not darken the front. Rough facets block light,
// which only the text loses.
TEST(Furnace, FromTheFrontTheConservingModeIsAsBrightAsTheText) {
  for (const double roughness : {0.0, 0.1, 0.3, 0.6, 1.0}) {
    for (const double ior : {1.2, 1.5, 2.0}) {
      for (const double color : {0.2, 1.0}) {
        Material m = white();
        m.base_color = Rgb(color);
        m.roughness = roughness;
        m.ior = ior;
        const double text = integrate(m, {0, 0, 1}, kSpec, 64).total.x;
        m.base_color = Rgb(1);
        const double blocked = 1 - integrate(m, {0, 0, 1}, kSpec, 64).total.x;
        m.base_color = Rgb(color);
        const double conserving = integrate(m, {0, 0, 1}, kConserving, 64).total.x;
        EXPECT_GT(conserving / text, 0.99)
            << "roughness " << roughness << ", ior " << ior << ", color " << color;
        EXPECT_LT(conserving / text, 1.01 + 1.2 * blocked)
            << "roughness " << roughness << ", ior " << ior << ", color " << color;
      }
    }
  }
}

TEST(Furnace, TheConservingModeNeverGainsWhateverTheDielectric) {
  for (const double roughness : {0.0, 0.1, 0.2, 0.4, 0.7, 1.0}) {
    for (const double ior : {1.1, 1.3, 1.5, 1.8, 2.5}) {
      for (const double specular : {0.3, 1.0}) {
        Material m = white();
        m.roughness = roughness;
        m.ior = ior;
        m.specular = specular;
        for (const double cosine : {0.02, 0.05, 0.1, 0.2, 0.35, 0.5, 0.7, 0.85, 1.0}) {
          EXPECT_LE(integrate(m, direction_of_cosine(cosine), kConserving, 64).total.x, 1.001)
              << "roughness " << roughness << ", ior " << ior << ", specular " << specular
              << ", cosine " << cosine;
        }
      }
    }
  }
}

TEST(Furnace, TheSampleImplementationGainsAtGrazingAngles) {
  // The mirror gives F(V.N) = 0.04 + 0.96 * 0.7^5; the diffuse rest is 1 - F averaged over lights.
  Material m = white();
  m.roughness = 0;
  const Albedo a = integrate(m, direction_of_cosine(0.3), kSpec);
  EXPECT_NEAR(a.specular_reflect.x, 0.04 + 0.96 * std::pow(0.7, 5), 1e-9);
  EXPECT_NEAR(a.diffuse_reflect.x, 0.949554, 1e-5);
  EXPECT_GT(a.total.x, 1.1);
  EXPECT_LE(integrate(m, direction_of_cosine(0.3)).total.x, 1.0);
}

TEST(Furnace, WithoutSpecularAllIsTheBaseColor) {
  Material m = white();
  m.base_color = {0.8, 0.5, 0.2};
  m.specular = 0;
  for (const double cosine : {0.1, 0.5, 1.0}) {
    EXPECT_TRUE(near(integrate(m, direction_of_cosine(cosine)).total, m.base_color, 1e-6));
  }
}

TEST(Furnace, SmoothGlassLosesNothing) {
  Material m = white();
  m.roughness = 0;
  m.transmission = 1;
  for (const double thickness : {0.0, 1.0}) {
    m.thickness = thickness;
    for (const double cosine : {-0.9, -0.3, 0.2, 0.9}) {
      EXPECT_NEAR(integrate(m, direction_of_cosine(cosine)).total.x, 1, 1e-9);
    }
  }
}

TEST(Furnace, NoDensityIsAboveOneInAll) {
  Chance chance(21);
  for (int i = 0; i < 20; ++i) {
    Material m = layered(chance, i % 7);
    m.roughness = m.clearcoat_roughness = chance.between(0.4, 1);
    const Bsdf bsdf(m, chance.anywhere());
    double sum = 0;
    constexpr int kDirections = 20000;
    for (int k = 0; k < kDirections; ++k) {
      const double z = 2 * (k + 0.5) / kDirections - 1;
      const double phi = k * 2.399963229728653;
      const double radius = std::sqrt(1 - z * z);
      sum += bsdf.evaluate({radius * std::cos(phi), radius * std::sin(phi), z}).pdf;
    }
    EXPECT_LE(sum * 4 * pi / kDirections, 1.001);
  }
}

TEST(Reciprocity, ViewerAndLightChangePlaces) {
  Chance chance(3);
  for (int i = 0; i < 3000; ++i) {
    Material m = chance.material();
    m.sheen_color = chance.color();
    m.sheen_roughness = chance.between(0.1, 1);
    m.iridescence = chance.number();
    m.anisotropy = chance.number();
    const Vec3d v = chance.anywhere();
    const Vec3d l = chance.anywhere();
    for (const ShaderOptions& options : {kSpec, kConserving}) {
      const Rgb there = evaluate(m, v, l, options);
      ASSERT_TRUE(near(there, evaluate(m, l, v, options), 1e-9 * (1 + max_value(there))));
    }
  }
}

TEST(Reciprocity, RefractionIsReciprocalButForTheSquareOfTheIndex) {
  Material m = white();
  m.transmission = 1;
  m.thickness = 1;
  m.roughness = 0.5;
  const Vec3d outside = direction_of_cosine(0.7);
  const Vec3d inside(-0.3, -0.2, -std::sqrt(1 - 0.13));
  const double there = evaluate(m, outside, inside, kSpec).x;
  const double back = evaluate(m, inside, outside, kSpec).x;
  ASSERT_GT(there, 0);
  EXPECT_NEAR(there / back, 1.5 * 1.5, 1e-9);
}

// The same to the last bit, so that pictures are the same bytes.
void expect_same_material(const Material& a, const Material& b, Chance& chance) {
  const Vec3d v = chance.anywhere();
  const Vec3d l = chance.anywhere();
  const Random3 random = chance.three();
  for (const ShaderOptions& options : {kSpec, kConserving}) {
    const Bsdf x(a, v, options);
    const Bsdf y(b, v, options);
    ASSERT_EQ(x.evaluate(l).f, y.evaluate(l).f);
    ASSERT_EQ(x.evaluate(l).pdf, y.evaluate(l).pdf);
    const auto p = x.sample(random);
    const auto q = y.sample(random);
    ASSERT_EQ(p.has_value(), q.has_value());
    if (!p) continue;
    ASSERT_EQ(p->l, q->l);
    ASSERT_EQ(p->weight, q->weight);
  }
}

TEST(Identity, LegacyTranslucencyIsItsUpgrade) {
  Chance chance(31);
  for (int i = 0; i < 500; ++i) {
    Material legacy = chance.material();
    Material upgraded = legacy;
    add_translucency(legacy, 0.4);
    upgraded.diffuse_transmission = 0.4;
    upgraded.diffuse_transmission_color = upgraded.base_color;
    expect_same_material(legacy, upgraded, chance);
  }
}

TEST(Identity, AFactorOfZeroIsTheCoreMaterial) {
  Chance chance(32);
  for (int i = 0; i < 500; ++i) {
    Material with = chance.material();
    with.diffuse_transmission = 0;
    Material without = with;
    without.diffuse_transmission_color = Rgb(1);
    expect_same_material(with, without, chance);
  }
}

TEST(Identity, FullTransmissionHidesDiffuseTransmission) {
  Chance chance(33);
  for (int i = 0; i < 500; ++i) {
    Material m = chance.material();
    m.transmission = 1;
    Material hidden = m;
    hidden.diffuse_transmission = 0;
    expect_same_material(m, hidden, chance);
  }
}

TEST(Identity, MetalTransmitsNothing) {
  Chance chance(34);
  for (int i = 0; i < 500; ++i) {
    Material m = chance.material();
    m.metallic = 1;
    Material plain = m;
    plain.transmission = plain.diffuse_transmission = 0;
    expect_same_material(m, plain, chance);
  }
}

TEST(Identity, TheTwoFacesOfAWallAreAlike) {
  Chance chance(35);
  for (int i = 0; i < 500; ++i) {
    const Material m = chance.material();
    const Vec3d v = chance.anywhere();
    const Vec3d l = chance.anywhere();
    ASSERT_EQ(evaluate(m, v, l), evaluate(m, mirrored(v), mirrored(l)));
  }
}

TEST(Identity, StrengthDecidesBetweenClearAndScatteringWalls) {
  Material m = white();
  m.roughness = 0.5;
  m.transmission = 1;
  m.base_color = {0.5, 0.6, 0.7};
  const Vec3d v = direction_of_cosine(0.8);
  const Vec3d behind = direction_of_cosine(-0.6);
  const Rgb clear = evaluate(m, v, behind, kSpec);
  m.scattering = Scattering::unified;
  m.scatter_color = {0.8, 0.4, 0.2};
  m.scatter_anisotropy = 0.5;
  m.scatter_strength = 0;
  EXPECT_EQ(evaluate(m, v, behind, kSpec), clear);
  m.scatter_strength = 1;
  // 3/4 of what passes goes on: (1 - F) * 3/4 * color / pi.
  const Directions d(v, behind);
  const double passed = 1 - (0.04 + 0.96 * pow5(1 - d.v_h));
  EXPECT_TRUE(near(evaluate(m, v, behind, kSpec), m.scatter_color * (0.75 * passed / pi), 1e-12));
  m.thickness = 1;  // with a volume the surface ignores it
  const Rgb boundary = evaluate(m, v, behind, kSpec);
  m.scattering = Scattering::none;
  EXPECT_EQ(evaluate(m, v, behind, kSpec), boundary);
}

TEST(Values, PaintByHand) {
  // V = L = N: D = 1 / (pi alpha^2), Vis = 1/4, F = 0.04.
  Material m = white();
  m.base_color = {0.9, 0.3, 0};
  m.roughness = 0.8;
  const Vec3d up(0, 0, 1);
  const double specular = 0.04 / (4 * pi * std::pow(0.8, 4));
  const Rgb expected = m.base_color * (0.96 / pi) + Rgb(specular);
  EXPECT_TRUE(near(evaluate(m, up, up, kSpec), expected, 1e-12));
}

TEST(Values, ALeafByHand) {
  // Light straight from behind: the mirrored half vector is the normal.
  Material m = white();
  m.base_color = {0.2, 0.5, 0.1};
  m.diffuse_transmission = 0.25;
  m.diffuse_transmission_color = {0.6, 0.9, 0.3};
  const Vec3d up(0, 0, 1);
  const Rgb expected = m.diffuse_transmission_color * (0.25 * 0.96 / pi);
  EXPECT_TRUE(near(evaluate(m, up, -up, kSpec), expected, 1e-12));
}

TEST(Values, ACoatByHand) {
  Material m = white();
  m.base_color = Rgb(0.5);
  m.specular = 0;
  m.clearcoat = 1;
  m.clearcoat_roughness = 0.5;
  const Vec3d up(0, 0, 1);
  const double coat = 1 / (4 * pi * std::pow(0.5, 4));
  EXPECT_NEAR(evaluate(m, up, up, kSpec).x, 0.96 * 0.5 / pi + 0.04 * coat, 1e-12);
  m.emissive = {3, 2, 1};
  EXPECT_TRUE(near(emitted(m, up), m.emissive * 0.96, 1e-12));
}

TEST(Values, SpecularGlossinessHasItsF0) {
  const Rgb specular(0.9, 0.5, 0.1);
  const Material m = specular_glossiness({0.2, 0.4, 0.6}, specular, 0.5);
  const Vec3d up(0, 0, 1);
  const double lobe = 1 / (4 * pi * std::pow(0.5, 4));
  const Rgb expected = Rgb(0.2, 0.4, 0.6) * (0.1 / pi) + specular * lobe;
  EXPECT_TRUE(near(evaluate(m, up, up, kSpec), expected, 1e-12));
}

TEST(Values, UnlitIsItsColor) {
  Material m;
  m.unlit = true;
  m.base_color = {0.1, 0.2, 0.3};
  m.clearcoat = 1;
  EXPECT_EQ(emitted(m, direction_of_cosine(0.3)), m.base_color);
  EXPECT_EQ(evaluate(m, {0, 0, 1}, {0, 0, 1}), Rgb());
  EXPECT_FALSE(sample(m, {0, 0, 1}, {}).has_value());
}

TEST(Values, ColorsOfADispersiveVolumeGoTheirOwnWay) {
  Material m = white();
  m.roughness = 0;
  m.transmission = 1;
  m.thickness = 1;
  m.dispersion = 5;
  const Vec3d v(0.6, 0, 0.8);
  double last = -1;
  for (const int channel : {0, 1, 2}) {
    const auto ray = sample(m, v, {0.99, 0, 0}, {ShaderMode::spec, channel});
    ASSERT_TRUE(ray);
    EXPECT_LT(ray->l.x, 0);
    EXPECT_GT(ray->l.x, last) << "blue is bent most";
    last = ray->l.x;
  }
}

}  // namespace
}  // namespace gltfx::shader
