// SPDX-License-Identifier: Apache-2.0
/// The tables of scales against their quadratures. With GLTFX_UPDATE_TABLES set in the environment
/// the tables are rewritten.
#include <cstdlib>
#include <map>
#include <span>
#include <string>
#include <utility>
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
    scale.row(row.scale);
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
    const TableCell azimuth = azimuth_row(azimuth_of(facets, flat));
    sum += mean_over_cosines([&](double cosine) {
      const TableCell cell = scale_column(cosine);
      double value = 0;
      for (std::size_t a = 0; a < azimuth.weights.size(); ++a) {
        for (std::size_t i = 0; i < cell.weights.size(); ++i)
          value += static_cast<double>(azimuth.weights[a] * cell.weights[i]) *
                   albedo[(azimuth.first + a) * kScaleColumns + cell.first + i];
      }
      return value;
    });
  }
  return sum / kTurns;
}

Microfacets facets_of(double along, double across) {
  return {std::max(square(along), kSmoothAlpha), std::max(square(across), kSmoothAlpha)};
}

template <class Value>
void write_values(TableFile& file, const Value& value) {
  file.open();
  for (int a = 0; a < kAzimuthRows; ++a) {
    std::vector<double> row;
    for (int i = 0; i < kScaleColumns; ++i) row.push_back(value(a, i));
    file.row(row);
  }
  file.close();
}

void write_anisotropic_albedo() {
  TableFile constant("anisotropic_constant");
  TableFile rising("anisotropic_rising");
  for (int r = 0; r < kAlongRows; ++r) {
    constant.open();
    rising.open();
    for (int c = 0; c < kAcrossRows; ++c) {
      const double along = along_roughness(r);
      const Microfacets facets = facets_of(along, along * across_ratio(c));
      std::map<std::pair<int, int>, SpecularAlbedo> albedos;
      for (int a = 0; a < kAzimuthRows; ++a) {
        for (int i = 0; i < kScaleColumns; ++i)
          albedos[{a, i}] = integrate_anisotropic_albedo(
              facets, direction_of_azimuth(facets, azimuth_part(a), scale_cosine(i)),
              kScaleResolution * 2);
      }
      write_values(constant, [&](int a, int i) { return albedos[{a, i}].constant; });
      write_values(rising, [&](int a, int i) { return albedos[{a, i}].rising; });
    }
    constant.close();
    rising.close();
  }
}

void write_anisotropic() {
  TableFile scale("anisotropic_scale");
  TableFile mean_albedo("anisotropic_mean");
  for (int r = 0; r < kAlongRows; ++r) {
    scale.open();
    std::vector<double> means;
    for (int c = 0; c < kAcrossRows; ++c) {
      const double along = along_roughness(r);
      const Microfacets facets = facets_of(along, along * across_ratio(c));
      const Balanced values = balance_anisotropic(facets, kScaleResolution);
      scale.open();
      for (std::size_t a = 0; a < kAzimuthRows; ++a) {
        scale.row(std::span(values.scale).subspan(a * kScaleColumns, kScaleColumns));
      }
      scale.close();
      means.push_back(mean_of(values.albedo, facets));
    }
    scale.close();
    mean_albedo.row(means);
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
          file.row(row);
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
  write_anisotropic_albedo();
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
