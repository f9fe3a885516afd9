// SPDX-License-Identifier: Apache-2.0
#include "shader/multiple_scattering.hpp"

#include <algorithm>

#include "base/lanes.hpp"
#include "shader/albedo_inside.hpp"

namespace gltfx::shader {
namespace {

constexpr std::array<float, kSpecularRows> kMeanAlbedo{
#include "shader/tables/mean_albedo.inc"
};
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

// Of a facet that reflects nothing but totally, and what F0 and F90 add.
using GlassAlbedo = std::array<std::array<float, kGlassColumns>, kGlassRows>;
using GlassParts = std::array<std::array<std::array<GlassAlbedo, 3>, 2>, kGlassIors>;
constexpr GlassParts kGlass{{
#include "shader/tables/glass_albedo.inc"
}};

// The tables are that close to quadratures where a lobe reflects or transmits all light.
constexpr double kAnisotropicMargin = 0.004;
constexpr double kGlassMargin = 0.004;
constexpr double kInsideMargin = 0.009;  // where total reflection begins within a cell

double glass_albedo(const Fresnel& fresnel, double roughness, double cosine) {
  const double ratio = std::max(fresnel.eta, 1 / fresnel.eta);
  const double root = std::sqrt(std::min(2 * (ratio - 1) / (ratio + 1), 1.0));
  const TableCell ior(root, kGlassIors);
  const TableCell row(roughness, kGlassRows);
  const TableCell column(std::sqrt(std::sqrt(cosine)), kGlassColumns);
  const std::array<float, 3> by{1, static_cast<float>(max_value(fresnel.f0)),
                                static_cast<float>(max_value(fresnel.f90))};
  const std::size_t side = fresnel.eta < 1 ? 1 : 0;
  Lanes sum{};
  for (std::size_t i = 0; i < ior.weights.size(); ++i) {
    for (std::size_t part = 0; part < by.size(); ++part) {
      const GlassAlbedo& rows = kGlass[ior.first + i][side][part];
      for (std::size_t r = 0; r < row.weights.size(); ++r)
        sum += ior.weights[i] * by[part] * row.weights[r] *
               load_lanes(rows[row.first + r].data() + column.first);
    }
  }
  return static_cast<double>(sum_of(sum * load_lanes(column.weights.data())));
}

// Four neighbours and the weights of the cubic through them: near the ends of a table, where values
// rise most, closer than the curve of TableCell.
struct CubicCell {
  std::size_t first;
  std::array<float, 4> weights;

  CubicCell(double x, int size) {
    const double scaled = std::clamp(x, 0.0, 1.0) * (size - 1);
    first = static_cast<std::size_t>(std::clamp(static_cast<int>(scaled) - 1, 0, size - 4));
    const auto t = static_cast<float>(scaled - static_cast<double>(first));
    weights = {(t - 1) * (t - 2) * (3 - t) / 6, t * (t - 2) * (t - 3) / 2,
               t * (t - 1) * (3 - t) / 2, t * (t - 1) * (t - 2) / 6};
  }
};

// The cells of the tables of anisotropic lobes that lead to the values of one.
struct AnisotropicCell {
  CubicCell row, column;

  explicit AnisotropicCell(const Microfacets& facets)
      : row(along_row(std::sqrt(facets.alpha_t)), kAlongRows),
        column(std::sqrt(std::sqrt(facets.alpha_b / facets.alpha_t)), kAcrossRows) {}

  /// visit(first index, second index, weight)
  template <class Visit>
  void visit(const Visit& visit_cell) const {
    for (std::size_t r = 0; r < row.weights.size(); ++r) {
      for (std::size_t c = 0; c < column.weights.size(); ++c)
        visit_cell(row.first + r, column.first + c, row.weights[r] * column.weights[c]);
    }
  }
};

void add(AnisotropicValues& sums, const AnisotropicValues& values, float weight) {
  for (std::size_t a = 0; a < kAzimuthRows; ++a) {
    for (std::size_t i = 0; i < kScaleColumns; ++i) sums[a][i] += weight * values[a][i];
  }
}

double interpolated(const AnisotropicValues& values, const TableCell& row,
                    const TableCell& column) {
  Lanes sums{};
  for (std::size_t a = 0; a < row.weights.size(); ++a)
    sums += row.weights[a] * load_lanes(values[row.first + a].data() + column.first);
  return static_cast<double>(sum_of(sums * load_lanes(column.weights.data())));
}

}  // namespace

double azimuth_of(const Microfacets& facets, const Vec3d& direction) {
  const double alpha = facets.under_azimuth(direction);
  const double least = std::sqrt(facets.alpha_b);
  const double range = std::sqrt(facets.alpha_t) - least;
  return range > 0 ? std::clamp((std::sqrt(alpha) - least) / range, 0.0, 1.0) : 0;
}

AnisotropicScale::AnisotropicScale(const Microfacets& facets) : facets_(facets) {
  AnisotropicCell(facets).visit([this](std::size_t along, std::size_t across, float weight) {
    add(values_, kAnisotropicScale[along][across], weight);
    mean_ += static_cast<double>(weight * kAnisotropicMean[along][across]);
  });
}

double AnisotropicScale::at(const Vec3d& direction) const {
  return interpolated(values_, azimuth_row(azimuth_of(facets_, direction)),
                      scale_column(std::min(direction.z, 1.0)));
}

AnisotropicAlbedo::AnisotropicAlbedo(const Microfacets& facets) : facets_(facets) {
  AnisotropicCell(facets).visit([this](std::size_t along, std::size_t across, float weight) {
    add(constant_, kAnisotropicConstant[along][across], weight);
    add(rising_, kAnisotropicRising[along][across], weight);
  });
}

SpecularAlbedo AnisotropicAlbedo::at(const Vec3d& direction) const {
  return at(azimuth_of(facets_, direction), direction.z);
}

SpecularAlbedo AnisotropicAlbedo::at(double azimuth, double cosine) const {
  const TableCell row = azimuth_row(azimuth);
  const TableCell column = scale_column(std::min(cosine, 1.0));
  return {interpolated(constant_, row, column), interpolated(rising_, row, column)};
}

MultipleScattering::MultipleScattering(const Microfacets& facets, const Vec3d& v) {
  if (facets.smooth()) return;
  if (facets.isotropic()) {
    kind_ = Kind::isotropic;
    const double roughness = std::sqrt(facets.alpha_b);
    curve_ = SpecularCurve(roughness);
    scale_v_ = curve_.scale(v.z);
    const TableCell row(roughness, kSpecularRows);
    mean_albedo_ = static_cast<double>(
        sum_of(load_lanes(kMeanAlbedo.data() + row.first) * load_lanes(row.weights.data())));
  } else {
    kind_ = Kind::anisotropic;
    anisotropic_ = std::make_unique<const AnisotropicScale>(facets);
    scale_v_ = anisotropic_->at(v) * (1 - kAnisotropicMargin);
    mean_albedo_ = anisotropic_->mean_albedo();
  }
}

MultipleScattering::MultipleScattering(const Fresnel& fresnel, const Microfacets& facets,
                                       const Vec3d& v) {
  if (facets.smooth() || std::fabs(fresnel.eta - 1) < 1e-9) return;
  kind_ = Kind::refracting;
  const bool in_table = facets.isotropic() && fresnel.film.strength <= 0;
  const double albedo = in_table ? glass_albedo(fresnel, std::sqrt(facets.alpha_b), v.z)
                                 : summed_albedo(fresnel, facets, v);
  const double margin = fresnel.eta < 1 ? kInsideMargin : kGlassMargin;
  scale_v_ = (1 - margin) / std::clamp(albedo, 0.1, 1.0);
}

Rgb mean_reflectance(const Fresnel& fresnel) {
  const Rgb plain = fresnel.f0 + (fresnel.f90 - fresnel.f0) * (1.0 / 21);
  if (fresnel.film.strength <= 0) return plain;
  // One cosine in the middle: the colour of what bounces needs no more.
  const Rgb film = fresnel.iridescent(0.7071067812);
  return plain * (1 - fresnel.film.strength) + film * fresnel.film.strength;
}

}  // namespace gltfx::shader
