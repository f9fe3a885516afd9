// SPDX-License-Identifier: Apache-2.0
/// Scales and albedos of anisotropic lobes, from tables.
#pragma once

#include <array>
#include <memory>

#include "shader/albedo.hpp"
#include "shader/microfacet.hpp"

namespace gltfx::shader {

/// The tables of anisotropic lobes: roughness along, roughness across over that, where the
/// roughness under the azimuth is between both, and the cosine.
inline constexpr int kAlongRows = 14;
inline constexpr int kAcrossRows = 9;
inline constexpr int kAzimuthRows = 7;
inline constexpr int kScaleColumns = 16;

/// The roughness along the direction of anisotropy of a row: close together where lobes are narrow.
inline double along_roughness(int row) {
  const double x = row / (kAlongRows - 1.0);
  return x * std::cbrt(x);
}
inline double along_row(double roughness) { return std::sqrt(roughness * std::sqrt(roughness)); }

/// The roughness across of a row over that along, and the part of the way from across to along of a
/// row of azimuths: close together across, where a lobe is narrow.
inline double across_ratio(int row) { return square(row / (kAcrossRows - 1.0)); }
inline double azimuth_part(int row) { return square(row / (kAzimuthRows - 1.0)); }
inline TableCell azimuth_row(double azimuth) { return {std::sqrt(azimuth), kAzimuthRows}; }
inline TableCell scale_column(double cosine) { return cosine_column(cosine, kScaleColumns); }

/// From 0 across to 1 along: the roughness under the azimuth of a direction.
double azimuth_of(const Microfacets& facets, const Vec3d& direction);
/// The part of a turn near each row of azimuths.
std::array<float, kAzimuthRows> azimuth_weights(const Microfacets& facets);

/// Four neighbours and the weights of the cubic through them: near the ends of a table, where
/// values rise most, closer than the curve of TableCell.
struct CubicCell {
  std::size_t first;
  std::array<float, 4> weights;

  CubicCell(double x, int size);
};

/// The cells of the tables that lead to the values of one lobe.
struct AnisotropicCell {
  CubicCell row, column;

  /// The precondition is that alpha_t is at least alpha_b.
  explicit AnisotropicCell(const Microfacets& facets);

  /// visit(first index, second index, weight)
  template <class Visit>
  void visit(const Visit& visit_cell) const {
    for (std::size_t r = 0; r < row.weights.size(); ++r) {
      for (std::size_t c = 0; c < column.weights.size(); ++c)
        visit_cell(row.first + r, column.first + c, row.weights[r] * column.weights[c]);
    }
  }
};

/// Values of one lobe: by azimuth_of() and cosine.
using AnisotropicValues = std::array<std::array<float, kScaleColumns>, kAzimuthRows>;

/// s of shader/multiple_scattering.hpp for one anisotropic lobe.
class AnisotropicScale {
 public:
  /// The precondition is that alpha_t is at least alpha_b.
  explicit AnisotropicScale(const Microfacets& facets);
  double at(const Vec3d& direction) const;
  double mean_albedo() const { return values_->mean; }

 private:
  struct Values {
    AnisotropicValues scale{};
    double mean = 0;
  };
  Microfacets facets_;
  std::shared_ptr<const Values> values_;
};

/// The albedo of one anisotropic lobe.
class AnisotropicAlbedo {
 public:
  /// The precondition is that alpha_t is at least alpha_b.
  explicit AnisotropicAlbedo(const Microfacets& facets);
  SpecularAlbedo at(const Vec3d& direction) const;
  /// `azimuth`: as azimuth_of().
  SpecularAlbedo at(double azimuth, double cosine) const;
  /// The mean over all azimuths at a cosine.
  SpecularAlbedo mean_at(const TableCell& column) const;

 private:
  struct Values {
    AnisotropicValues constant{}, rising{};
    std::array<float, kScaleColumns> mean_constant{}, mean_rising{};
  };
  static Values values_of(const Microfacets& facets);

  Microfacets facets_;
  std::shared_ptr<const Values> values_;
};

}  // namespace gltfx::shader
