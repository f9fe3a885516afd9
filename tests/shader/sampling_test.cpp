// SPDX-License-Identifier: Apache-2.0
/// Directions are sampled with the returned density, for each lobe and for whole materials.
#include <array>
#include <cmath>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "random.hpp"
#include "shader/material.hpp"

namespace gltfx::shader {
namespace {

using test::Chance;
using test::direction_of_cosine;

constexpr int kRings = 16;    // even in the cosine, over both hemispheres
constexpr int kSectors = 16;  // of a turn
constexpr int kSamples = 40000;

struct Histogram {
  std::array<double, kRings * kSectors> cells{};
  double none = 0;

  void add(const Vec3d& l) {
    const double turn = std::atan2(l.y, l.x) / (2 * pi) + 0.5;
    const int ring = std::min(static_cast<int>((l.z + 1) / 2 * kRings), kRings - 1);
    const int sector = std::min(static_cast<int>(turn * kSectors), kSectors - 1);
    ++cells[static_cast<std::size_t>(ring * kSectors + sector)];
  }
};

Vec3d at(double cosine, double turn) {
  const double radius = std::sqrt(1 - square(cosine));
  const double phi = 2 * pi * (turn - 0.5);
  return {radius * std::cos(phi), radius * std::sin(phi), cosine};
}

// Integral of a density over each cell.
template <class Density>
Histogram integrate(const Density& density) {
  constexpr int kSteps = 12;
  constexpr double kArea = 4 * pi / (kRings * kSectors * kSteps * kSteps);
  Histogram sums;
  sums.none = 1;
  for (int i = 0; i < kRings * kSteps; ++i) {
    for (int j = 0; j < kSectors * kSteps; ++j) {
      const double p = kArea * density(at(2 * (i + 0.5) / (kRings * kSteps) - 1,
                                          (j + 0.5) / (kSectors * kSteps)));
      sums.cells[static_cast<std::size_t>(i / kSteps * kSectors + j / kSteps)] += p;
      sums.none -= p;
    }
  }
  return sums;
}

// Pearson's test in the cube root form of Wilson and Hilferty: standard deviations above what
// chance gives. Cells with few samples are taken together.
double surprise(const Histogram& prepared, const Histogram& share, int count) {
  double sum = 0;
  int cells = -1;
  double rest_seen = prepared.none;
  double rest_expected = std::fmax(share.none, 0) * count;
  const auto compare = [&](double observed, double expected) {
    sum += square(observed - expected) / expected;
    ++cells;
  };
  for (std::size_t i = 0; i < prepared.cells.size(); ++i) {
    const double expected = share.cells[i] * count;
    if (expected >= 8) {
      compare(prepared.cells[i], expected);
    } else {
      rest_seen += prepared.cells[i];
      rest_expected += expected;
    }
  }
  if (rest_expected >= 8) compare(rest_seen, rest_expected);
  const double k = cells;
  return (std::cbrt(sum / k) - (1 - 2 / (9 * k))) / std::sqrt(2 / (9 * k));
}

template <class Take, class Density>
void expect_agreement(const Take& take, const Density& density, const std::string& name) {
  Chance chance(5);
  Histogram prepared;
  for (int i = 0; i < kSamples; ++i) {
    const std::optional<Vec3d> l = take(chance.three());
    l ? prepared.add(*l) : static_cast<void>(++prepared.none);
  }
  const Histogram share = integrate(density);
  EXPECT_GT(share.none, -0.003) << name << ": the density is above 1 in all";
  EXPECT_LT(surprise(prepared, share, kSamples), 4) << name;
}

// All leaves of a material, one by one.
struct LeafTest {
  Vec3d v;
  std::string name;

  template <class Leaf>
  void operator()(const Leaf& leaf, double) const {
    if (leaf.is_delta) return;
    expect_agreement(
        [&](const Random3& r) -> std::optional<Vec3d> {
          const Proposal p = leaf.sample(v, r);
          return p.valid ? std::optional(p.l) : std::nullopt;
        },
        [&](const Vec3d& l) { return leaf.pdf(Directions(v, l)); },
        name + " " + typeid(leaf).name());
  }
};

struct Named {
  std::string name;
  Material material;
};

std::vector<Named> materials() {
  Material paint;
  paint.metallic = 0;
  paint.roughness = 0.5;
  std::vector<Named> all{{"paint", paint}};
  const auto add = [&](const std::string& name, const auto& change) {
    all.push_back({name, paint});
    change(all.back().material);
  };
  add("metal", [](Material& m) { m.metallic = 1; });
  add("brushed metal", [](Material& m) {
    m.metallic = 1;
    m.anisotropy = 0.7;
    m.anisotropy_rotation = 1.7;
  });
  add("sandstone", [](Material& m) { m.diffuse_roughness = 0.8; });
  add("leaf", [](Material& m) { m.diffuse_transmission = 0.6; });
  add("frosted pane", [](Material& m) { m.transmission = 0.8; });
  add("glass", [](Material& m) {
    m.transmission = 1;
    m.thickness = 1;
  });
  add("candle", [](Material& m) {
    m.thickness = 1;
    m.diffuse_transmission = 0.7;
    m.transmission = 0.3;
  });
  add("lampshade", [](Material& m) {
    m.transmission = 1;
    m.scattering = Scattering::unified;
    m.scatter_color = Rgb(0.8);
    m.scatter_strength = 0.7;
    m.scatter_anisotropy = 0.4;
  });
  add("velvet", [](Material& m) {
    m.sheen_color = Rgb(0.8);
    m.sheen_roughness = 0.4;
  });
  add("varnish", [](Material& m) {
    m.clearcoat = 1;
    m.clearcoat_roughness = 0.4;
    m.clearcoat_normal = normalize({0.2, -0.1, 1});
  });
  add("soap", [](Material& m) { m.iridescence = 1; });
  return all;
}

TEST(Sampling, LeavesAreTakenWithTheirDensity) {
  for (const Named& named : materials()) {
    const Vec3d v = direction_of_cosine(0.6);
    const Prepared prepared(named.material, v, named.material.ior, ShaderMode::conserving);
    const PreparedLayers layers(named.material, v, ShaderMode::conserving);
    const auto graph = material_graph(named.material, prepared, layers);
    const LeafTest test{v, named.name};
    visit_node(graph, test, 1);
  }
}

TEST(Sampling, MaterialsAreTakenWithTheirDensity) {
  for (const Named& named : materials()) {
    for (const double cosine : {0.9, 0.25, -0.5}) {
      const Vec3d v = direction_of_cosine(cosine);
      const Bsdf bsdf(named.material, v);
      expect_agreement(
          [&](const Random3& r) -> std::optional<Vec3d> {
            const auto sample = bsdf.sample(r);
            return sample ? std::optional(sample->l) : std::nullopt;
          },
          [&](const Vec3d& l) {  // where nothing is reflected the path ends
            const Evaluation e = bsdf.evaluate(l);
            return max_value(e.f) > 0 ? e.pdf : 0;
          },
          named.name);
    }
  }
}

TEST(Sampling, TheWeightIsTheValueOverTheDensity) {
  Chance chance(8);
  for (int i = 0; i < 3000; ++i) {
    Material m = chance.material();
    m.clearcoat = chance.number();
    m.clearcoat_roughness = 0.3;
    m.sheen_color = chance.color();
    m.sheen_roughness = chance.between(0.1, 1);
    m.thickness = i % 2;
    const Bsdf bsdf(m, chance.anywhere());
    const auto sample = bsdf.sample(chance.three());
    if (!sample) continue;
    const Evaluation e = bsdf.evaluate(sample->l);
    ASSERT_NEAR(sample->pdf, e.pdf, 1e-9 * e.pdf);
    const Rgb expected = e.f * (std::fabs(sample->l.z) / e.pdf);
    for (int c = 0; c < 3; ++c) {
      ASSERT_NEAR(sample->weight[c], expected[c], 1e-9 * (1 + expected[c]));
    }
  }
}

TEST(Sampling, SmoothSurfacesSendRaysWhereGeometrySaysSo) {
  Material glass;
  glass.metallic = 0;
  glass.roughness = 0;
  glass.transmission = 1;
  glass.thickness = 1;
  const Vec3d v(0.6, 0, 0.8);
  const Bsdf bsdf(glass, v);
  EXPECT_TRUE(bsdf.is_delta());
  EXPECT_EQ(bsdf.evaluate({-0.6, 0, 0.8}).f, Rgb());
  const auto reflected = bsdf.sample({0, 0.5, 0.5});
  ASSERT_TRUE(reflected && reflected->delta);
  EXPECT_NEAR(reflected->l.x, -0.6, 1e-12);
  EXPECT_NEAR(reflected->l.z, 0.8, 1e-12);
  const auto refracted = bsdf.sample({0.99, 0.5, 0.5});
  ASSERT_TRUE(refracted && refracted->delta);
  EXPECT_NEAR(refracted->l.x, -0.4, 1e-12);  // Snell: 0.6 / 1.5
  EXPECT_LT(refracted->l.z, 0);
  const double f = 0.04 + 0.96 * std::pow(0.2, 5);
  EXPECT_NEAR(reflected->weight.x * reflected->pdf, f, 1e-12);
  EXPECT_NEAR(refracted->weight.x * refracted->pdf, 1 - f, 1e-12);
  // From inside, beyond the critical angle, nothing leaves.
  const Bsdf inside(glass, {0.8, 0, -0.6});
  for (const double lobe : {0.0, 0.5, 0.9}) {
    const auto back = inside.sample({lobe, 0.5, 0.5});
    ASSERT_TRUE(back);
    EXPECT_NEAR(back->l.z, -0.6, 1e-12);
  }
}

TEST(Sampling, EqualMediaLetLightPassStraight) {
  Material air;
  air.metallic = 0;
  air.roughness = 0.7;
  air.transmission = 1;
  air.thickness = 1;
  air.ior = 1;
  air.specular = 0;
  const auto sample = Bsdf(air, {0.6, 0, 0.8}).sample({0.5, 0.5, 0.5});
  ASSERT_TRUE(sample && sample->delta);
  EXPECT_NEAR(sample->l.x, -0.6, 1e-12);
  EXPECT_NEAR(sample->l.z, -0.8, 1e-12);
  EXPECT_NEAR(sample->weight.x, 1, 1e-12);
}

}  // namespace
}  // namespace gltfx::shader
