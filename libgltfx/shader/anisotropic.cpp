// SPDX-License-Identifier: Apache-2.0
#include "shader/anisotropic.hpp"

#include <algorithm>
#include <cmath>

#include "base/remembered.hpp"

namespace gltfx::shader {
namespace {

using AnisotropicTable = std::array<std::array<AnisotropicValues, kAcrossRows>, kAlongRows>;
constexpr AnisotropicTable kAnisotropicScale{{
#include "shader/tables/anisotropic_scale.inc"
}};
constexpr AnisotropicTable kAnisotropicConstant{{
#include "shader/tables/anisotropic_constant.inc"
}};
constexpr AnisotropicTable kAnisotropicRising{{
#include "shader/tables/anisotropic_rising.inc"
}};
constexpr std::array<std::array<float, kAcrossRows>, kAlongRows> kAnisotropicMean{{
#include "shader/tables/anisotropic_mean.inc"
}};

// Lobes of one shape, whatever their direction.
struct LobeShape {
  double along = 0, across = 0;
  bool operator==(const LobeShape&) const = default;
};

LobeShape shape_of(const Microfacets& facets) { return {facets.alpha_t, facets.alpha_b}; }

// Of the materials that paths meet in turn. Textures change them from hit to hit.
constexpr std::size_t kRememberedLobes = 4;

void add(AnisotropicValues& sums, const AnisotropicValues& values, float weight) {
  for (std::size_t a = 0; a < kAzimuthRows; ++a) {
    for (std::size_t i = 0; i < kScaleColumns; ++i) sums[a][i] += weight * values[a][i];
  }
}

}  // namespace

double azimuth_of(const Microfacets& facets, const Vec3d& direction) {
  const double alpha = facets.under_azimuth(direction);
  const double least = std::sqrt(facets.alpha_b);
  const double range = std::sqrt(facets.alpha_t) - least;
  return range > 0 ? std::clamp((std::sqrt(alpha) - least) / range, 0.0, 1.0) : 0;
}

std::array<float, kAzimuthRows> azimuth_weights(const Microfacets& facets) {
  constexpr int kTurns = 12;  // in a quarter of one, which is like the others
  std::array<float, kAzimuthRows> sums{};
  for (int i = 0; i < kTurns; ++i) {
    const SinCos turn = sin_cos_of((i + 0.5) / (4 * kTurns));
    const TableCell cell =
        azimuth_row(azimuth_of(facets, facets.turned_back({turn.cosine, turn.sine, 0})));
    for (std::size_t k = 0; k < cell.weights.size(); ++k)
      sums[cell.first + k] += cell.weights[k] / kTurns;
  }
  return sums;
}

CubicCell::CubicCell(double x, int size) {
  const double scaled = std::clamp(x, 0.0, 1.0) * (size - 1);
  first = static_cast<std::size_t>(std::clamp(static_cast<int>(scaled) - 1, 0, size - 4));
  const auto t = static_cast<float>(scaled - static_cast<double>(first));
  weights = {(t - 1) * (t - 2) * (3 - t) / 6, t * (t - 2) * (t - 3) / 2, t * (t - 1) * (3 - t) / 2,
             t * (t - 1) * (t - 2) / 6};
}

AnisotropicCell::AnisotropicCell(const Microfacets& facets)
    : row(along_row(std::sqrt(facets.alpha_t)), kAlongRows),
      column(std::sqrt(std::sqrt(facets.alpha_b / facets.alpha_t)), kAcrossRows) {}

AnisotropicScale::AnisotropicScale(const Microfacets& facets) : facets_(facets) {
  thread_local Remembered<LobeShape, Values, kRememberedLobes> known;
  values_ = known.get(shape_of(facets), [&facets] {
    Values values;
    AnisotropicCell(facets).visit([&](std::size_t along, std::size_t across, float weight) {
      add(values.scale, kAnisotropicScale[along][across], weight);
      values.mean += static_cast<double>(weight * kAnisotropicMean[along][across]);
    });
    return values;
  });
}

double AnisotropicScale::at(const Vec3d& direction) const {
  return interpolated(values_->scale, azimuth_row(azimuth_of(facets_, direction)),
                      scale_column(std::min(direction.z, 1.0)));
}

AnisotropicAlbedo::Values AnisotropicAlbedo::values_of(const Microfacets& facets) {
  Values values;
  AnisotropicCell(facets).visit([&](std::size_t along, std::size_t across, float weight) {
    add(values.constant, kAnisotropicConstant[along][across], weight);
    add(values.rising, kAnisotropicRising[along][across], weight);
  });
  const auto weights = azimuth_weights(facets);
  for (std::size_t a = 0; a < kAzimuthRows; ++a) {
    for (std::size_t i = 0; i < kScaleColumns; ++i) {
      values.mean_constant[i] += weights[a] * values.constant[a][i];
      values.mean_rising[i] += weights[a] * values.rising[a][i];
    }
  }
  return values;
}

AnisotropicAlbedo::AnisotropicAlbedo(const Microfacets& facets) : facets_(facets) {
  thread_local Remembered<LobeShape, Values, kRememberedLobes> known;
  values_ = known.get(shape_of(facets), [&facets] { return values_of(facets); });
}

SpecularAlbedo AnisotropicAlbedo::at(const Vec3d& direction) const {
  return at(azimuth_of(facets_, direction), direction.z);
}

SpecularAlbedo AnisotropicAlbedo::at(double azimuth, double cosine) const {
  const TableCell row = azimuth_row(azimuth);
  const TableCell column = scale_column(std::min(cosine, 1.0));
  return {interpolated(values_->constant, row, column), interpolated(values_->rising, row, column)};
}

SpecularAlbedo AnisotropicAlbedo::mean_at(const TableCell& column) const {
  return {interpolated(values_->mean_constant, column), interpolated(values_->mean_rising, column)};
}

}  // namespace gltfx::shader
