// SPDX-License-Identifier: Apache-2.0
/// The tables of scales against their quadratures. With GLTFX_UPDATE_TABLES set in the environment
/// the tables are rewritten.
#include <cstdlib>
#include <span>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "random.hpp"
#include "scale_integrals.hpp"
#include "table_file.hpp"

namespace gltfx::shader {
namespace {

using test::Chance;

constexpr int kScaleResolution = 80;

void write_isotropic() {
  TableFile scale("specular_scale");
  TableFile mean_albedo("mean_albedo");
  std::vector<double> means;
  for (int r = 0; r < kSpecularRows; ++r) {
    const Balanced row = balance_isotropic(row_roughness(r, kSpecularRows), kScaleResolution);
    scale.open();
    scale.numbers(row.scale);
    scale.close();
    means.push_back(mean_over_cosines([&](double cosine) {
      const TableCell cell = albedo_column(cosine);
      double sum = 0;
      for (std::size_t i = 0; i < cell.weights.size(); ++i)
        sum += static_cast<double>(cell.weights[i]) * row.albedo[cell.first + i];
      return sum;
    }));
  }
  mean_albedo.numbers(means);
}

// Of one pair of roughnesses, over all azimuths.
double mean_of(const std::vector<double>& albedo, const Microfacets& facets) {
  constexpr int kTurns = 64;
  double sum = 0;
  for (int t = 0; t < kTurns; ++t) {
    const double angle = pi / 2 * (t + 0.5) / kTurns;
    const Vec3d flat(std::cos(angle), std::sin(angle), 0);
    const double place = AnisotropicScale::azimuth(facets, flat) * (kAzimuthRows - 1);
    const std::size_t below =
        std::min(static_cast<std::size_t>(place), std::size_t{kAzimuthRows - 2});
    const double part = place - static_cast<double>(below);
    sum += mean_over_cosines([&](double cosine) {
      const TableCell cell = scale_column(cosine);
      double value = 0;
      for (std::size_t i = 0; i < cell.weights.size(); ++i) {
        const std::size_t at = below * kScaleColumns + cell.first + i;
        value += static_cast<double>(cell.weights[i]) *
                 ((1 - part) * albedo[at] + part * albedo[at + kScaleColumns]);
      }
      return value;
    });
  }
  return sum / kTurns;
}

Microfacets facets_of(double along, double across) {
  return {std::max(square(along), kSmoothAlpha), std::max(square(across), kSmoothAlpha)};
}

void write_anisotropic() {
  TableFile scale("anisotropic_scale");
  TableFile mean_albedo("anisotropic_mean");
  for (int r = 0; r < kAlongRows; ++r) {
    scale.open();
    std::vector<double> means;
    for (int c = 0; c < kAcrossRows; ++c) {
      const double along = along_roughness(r);
      const Microfacets facets = facets_of(along, along * c / (kAcrossRows - 1.0));
      const Balanced values = balance_anisotropic(facets, kScaleResolution);
      scale.open();
      for (std::size_t a = 0; a < kAzimuthRows; ++a) {
        scale.open();
        scale.numbers(std::span(values.scale).subspan(a * kScaleColumns, kScaleColumns));
        scale.close();
      }
      scale.close();
      means.push_back(mean_of(values.albedo, facets));
    }
    scale.close();
    mean_albedo.open();
    mean_albedo.numbers(means);
    mean_albedo.close();
  }
}

void write_glass() {
  TableFile file("glass_albedo");
  for (int n = 0; n < kGlassIors; ++n) {
    file.open();
    for (const bool inside : {false, true}) {
      file.open();
      for (const int part : {0, 1, 2}) {
        file.open();
        for (int r = 0; r < kGlassRows; ++r) {
          std::vector<double> row;
          for (int c = 0; c < kGlassColumns; ++c) {
            const double eta = inside ? 1 / glass_ior(n) : glass_ior(n);
            row.push_back(integrate_glass_albedo(eta, row_roughness(r, kGlassRows), scale_cosine(c),
                                                 kScaleResolution)[part]);
          }
          file.open();
          file.numbers(row);
          file.close();
        }
        file.close();
      }
      file.close();
    }
    file.close();
  }
}

bool asked_for() { return std::getenv("GLTFX_UPDATE_TABLES") != nullptr; }

TEST(ScaleTables, OfIsotropicLobesAreWrittenWhenAskedFor) {
  if (!asked_for()) GTEST_SKIP();
  write_isotropic();
}

TEST(ScaleTables, OfAnisotropicLobesAreWrittenWhenAskedFor) {
  if (!asked_for()) GTEST_SKIP();
  write_anisotropic();
}

TEST(ScaleTables, OfGlassAreWrittenWhenAskedFor) {
  if (!asked_for()) GTEST_SKIP();
  write_glass();
}

// The scale is checked by what it is for: albedos of white lobes, in furnace_test.cpp.
TEST(ScaleTables, MeansAreThoseOfAlbedos) {
  for (const double roughness : {0.2, 0.5, 1.0}) {
    const MultipleScattering bounces(microfacets(roughness), {0, 0, 1});
    const double mean = mean_over_cosines([&](double cosine) {
      const SpecularAlbedo albedo = SpecularCurve(roughness).at(cosine);
      return albedo.constant + albedo.rising;
    });
    EXPECT_NEAR(bounces.tint(Rgb(0.5)).x, 0.5 * mean / (1 - 0.5 * (1 - mean)), 1e-3) << roughness;
  }
}

}  // namespace
}  // namespace gltfx::shader
