// SPDX-License-Identifier: Apache-2.0
/// Each parameter of a material at its ends, alone and with each other one, in an even light: the
/// conserving mode never gives back more of a colour than it gets, and nearly all where nothing is
/// absorbed.
/// Values of both modes are finite and reciprocal.
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "random.hpp"
#include "shader/material.hpp"

namespace gltfx::shader {
namespace {

using test::Chance;
using test::direction_of_cosine;

enum Trait : unsigned {
  kNone = 0,
  kCoated = 1,  // not reciprocal, as the text has it
  kVolume = 2,  // neither
  kSheen = 4,
  kFilm = 8,
  kAbsorbs = 16,
  kAnisotropic = 32,
  kTilted = 64,   // reflects below the horizon
  kNarrow = 128,  // light from near the horizon, for a fine quadrature
};

struct Setting {
  const char* name;
  void (*apply)(Material&);
  unsigned traits = kNone;
};

// Values at the ends of each parameter, on a white dielectric of roughness 0.4.
const std::vector<Setting>& settings() {
  static const std::vector<Setting> all{
      {"metallic 1", [](Material& m) { m.metallic = 1; }},
      {"metallic 0.5", [](Material& m) { m.metallic = 0.5; }},
      {"roughness 0", [](Material& m) { m.roughness = 0; }},
      {"roughness 0.1", [](Material& m) { m.roughness = 0.1; }},
      {"roughness 1", [](Material& m) { m.roughness = 1; }},
      {"base color 0", [](Material& m) { m.base_color = {}; }, kAbsorbs},
      {"ior 1", [](Material& m) { m.ior = 1; }},
      {"ior 2.5", [](Material& m) { m.ior = 2.5; }},
      {"ior 0", [](Material& m) { m.ior = 0; }},
      {"specular 0", [](Material& m) { m.specular = 0; }},
      {"specular color 0", [](Material& m) { m.specular_color = {}; }},
      {"specular color 30", [](Material& m) { m.specular_color = Rgb(30); }},
      {"transmission 1", [](Material& m) { m.transmission = 1; }},
      {"transmission 0.5", [](Material& m) { m.transmission = 0.5; }},
      {"diffuse transmission 1", [](Material& m) { m.diffuse_transmission = 1; }},
      {"diffuse roughness 1", [](Material& m) { m.diffuse_roughness = 1; }},
      {"thickness 1", [](Material& m) { m.thickness = 1; }, kVolume},
      {"dispersion 5", [](Material& m) { m.dispersion = 5; }},
      {"sheen of 0", [](Material& m) { m.sheen_color = Rgb(1); }, kSheen | kNarrow},
      {"sheen of 0.05", [](Material& m) { m.sheen_color = Rgb(1), m.sheen_roughness = 0.05; },
       kSheen | kNarrow},
      {"sheen of 0.15", [](Material& m) { m.sheen_color = Rgb(1), m.sheen_roughness = 0.15; },
       kSheen},
      {"half a sheen of 0.3",
       [](Material& m) { m.sheen_color = Rgb(0.5), m.sheen_roughness = 0.3; }, kSheen},
      {"sheen of 1", [](Material& m) { m.sheen_color = Rgb(1), m.sheen_roughness = 1; }, kSheen},
      {"coat of 0", [](Material& m) { m.clearcoat = 1; }, kCoated},
      {"coat of 1", [](Material& m) { m.clearcoat = m.clearcoat_roughness = 1; }, kCoated},
      {"tilted coat",
       [](Material& m) {
         m.clearcoat = 1, m.clearcoat_normal = normalize({0.3, 0, 1});
       },
       kCoated | kTilted},
      {"anisotropy 0.5", [](Material& m) { m.anisotropy = 0.5, m.anisotropy_rotation = 1; },
       kAnisotropic},
      {"anisotropy 1", [](Material& m) { m.anisotropy = 1; }, kAnisotropic},
      {"film", [](Material& m) { m.iridescence = 1; }, kFilm},
      {"half a film", [](Material& m) { m.iridescence = 0.5; }, kFilm},
      {"film of ior 1", [](Material& m) { m.iridescence = m.iridescence_ior = 1; }},
      {"film of ior 1.02", [](Material& m) { m.iridescence = 1, m.iridescence_ior = 1.02; }, kFilm},
      {"film of ior 2.5", [](Material& m) { m.iridescence = 1, m.iridescence_ior = 2.5; }, kFilm},
      {"film of ior 1.8, 200 nm",
       [](Material& m) {
         m.iridescence = 1, m.iridescence_ior = 1.8, m.iridescence_thickness = 200;
       },
       kFilm},
      {"film of 0 nm", [](Material& m) { m.iridescence = 1, m.iridescence_thickness = 0; }},
      {"film of 1200 nm", [](Material& m) { m.iridescence = 1, m.iridescence_thickness = 1200; },
       kFilm},
      {"scattering wall",
       [](Material& m) {
         m.transmission = 1, m.scattering = Scattering::unified, m.scatter_color = Rgb(1);
       }},
  };
  return all;
}

struct Point {
  std::string name;
  Material material;
  unsigned traits;

  bool is(unsigned trait) const { return (traits & trait) != 0; }
};

Point point_of(const Setting& one, const Setting& other) {
  Point point{std::string(one.name) + ", " + other.name, {}, one.traits | other.traits};
  point.material.metallic = 0;
  point.material.roughness = 0.4;
  one.apply(point.material);
  other.apply(point.material);
  return point;
}

// Alone, as a pair with itself, and in pairs.
std::vector<Point> points() {
  std::vector<Point> all;
  for (std::size_t i = 0; i < settings().size(); ++i) {
    for (std::size_t j = i; j < settings().size(); ++j)
      all.push_back(point_of(settings()[i], settings()[j]));
  }
  return all;
}

double most_of(const Point& p) {
  if (p.is(kVolume)) return 1.02;  // the quadrature meets the edge of total reflection
  if (p.is(kSheen)) return 1.005;
  if (p.is(kAnisotropic)) return 1.004;
  return p.is(kFilm) ? 1.0025 : 1.0015;
}

double least_of(const Point& p) {
  if (p.is(kAbsorbs)) return 0;
  if (p.is(kTilted)) return 0.8;
  if (p.is(kSheen) && p.is(kAnisotropic | kFilm)) return 0.97;
  if (p.is(kSheen | kFilm) && p.material.diffuse_roughness > 0) return 0.975;
  return p.material.metallic == 1 ? 0.99 : 0.98;
}

double least_value(const Rgb& color) { return std::min({color.x, color.y, color.z}); }

TEST(FurnaceOfPairs, NothingIsGainedAndLittleLost) {
  for (const Point& point : points()) {
    const int resolution = point.is(kNarrow) ? 128 : 32;
    for (const double cosine : {-0.7, -0.2, 0.15, 0.5, 1.0}) {
      if (cosine < 0 && !point.is(kVolume)) continue;
      const Rgb total =
          integrate(point.material, direction_of_cosine(cosine), {}, resolution).total;
      EXPECT_LE(max_value(total), most_of(point)) << point.name << ", cosine " << cosine;
      EXPECT_GE(least_value(total), least_of(point)) << point.name << ", cosine " << cosine;
    }
  }
}

TEST(FurnaceOfPairs, ValuesAreFiniteAndReciprocal) {
  Chance chance(71);
  for (const Point& point : points()) {
    for (const ShaderMode mode : {ShaderMode::spec, ShaderMode::conserving}) {
      for (int i = 0; i < 4; ++i) {
        const Vec3d v = chance.upwards();
        const Vec3d l = i % 2 == 0 ? chance.upwards() : -chance.upwards();
        const Rgb there = evaluate(point.material, v, l, {mode, -1});
        for (const double value : {there.x, there.y, there.z}) {
          ASSERT_TRUE(std::isfinite(value) && value >= 0) << point.name;
        }
        if (point.is(kCoated | kVolume)) continue;
        const Rgb back = evaluate(point.material, l, v, {mode, -1});
        for (int c = 0; c < 3; ++c)
          ASSERT_NEAR(there[c], back[c], 1e-9 * (1 + there[c])) << point.name;
      }
    }
  }
}

TEST(FurnaceOfPairs, FilmsThatAreNoneChangeNothing) {
  Chance chance(72);
  const auto expect_nothing = [&](const Material& with, const std::string& name) {
    Material without = with;
    without.iridescence = 0;
    for (const ShaderMode mode : {ShaderMode::spec, ShaderMode::conserving}) {
      const Vec3d v = chance.upwards();
      const Vec3d l = chance.upwards();
      EXPECT_EQ(evaluate(with, v, l, {mode, -1}), evaluate(without, v, l, {mode, -1})) << name;
      EXPECT_EQ(evaluate(with, v, -l, {mode, -1}), evaluate(without, v, -l, {mode, -1})) << name;
      EXPECT_EQ(integrate(with, v, {mode, -1}, 8).total, integrate(without, v, {mode, -1}, 8).total)
          << name;
    }
  };
  for (const Setting& setting : settings()) {
    for (const double metallic : {0.0, 1.0}) {
      for (const double ior : {1.0, 1.3, 2.0}) {
        for (const double thickness : {0.0, 100.0, 700.0}) {
          if (ior > 1 && thickness > 0) continue;
          Material m;
          m.metallic = metallic;
          m.roughness = 0.3;
          setting.apply(m);
          m.iridescence = 1;
          m.iridescence_ior = ior;
          m.iridescence_thickness = thickness;
          expect_nothing(m, setting.name);
        }
      }
    }
  }
}

TEST(FurnaceOfPairs, ABlackMetalReflectsUnderAFilm) {
  Material black;
  black.base_color = {};
  black.roughness = 0.3;
  black.iridescence = 1;
  for (const ShaderMode mode : {ShaderMode::spec, ShaderMode::conserving}) {
    EXPECT_GT(integrate(black, {0, 0, 1}, {mode, -1}).total.y, 0.004);
  }
}

// Light that facets reflect twice or three times has their colour as often.
TEST(FurnaceOfPairs, RoughMetalHasAMoreSaturatedColor) {
  const Rgb copper(0.95, 0.64, 0.54);
  Material m;
  m.base_color = copper;
  m.roughness = 1;
  const Rgb seen = integrate(m, {0, 0, 1}).total;
  for (int c = 0; c < 3; ++c) {
    EXPECT_LT(seen[c], copper[c]);
    EXPECT_GT(seen[c], copper[c] * copper[c] * copper[c]);
  }
  EXPECT_LT(seen.z / seen.x, copper.z / copper.x - 0.05);
}

}  // namespace
}  // namespace gltfx::shader
