// SPDX-License-Identifier: Apache-2.0
/// Directional albedos: parts of light that lobes send back, by the cosine of the view.
///
/// The shader reads them from tables over roughness and the fourth root of the cosine. A test
/// compares the tables with quadratures, or rewrites them.
#pragma once

#include <array>
#include <cstddef>

#include "shader/table.hpp"

namespace gltfx::shader {

// Rows by roughness from 0 to 1, columns by the fourth root of the cosine from 0 to 1.
inline constexpr int kAlbedoColumns = 48;
inline constexpr int kSpecularRows = 32;
inline constexpr int kSheenRows = 48;

inline TableCell albedo_column(double cosine) { return cosine_column(cosine, kAlbedoColumns); }

/// The albedo of specular_brdf under Schlick's Fresnel: f0 * constant + f90 * rising.
struct SpecularAlbedo {
  double constant = 0, rising = 0;  ///< integrals of 1 - w and of w, w = (1 - V.H)^5
};

/// The albedos for some cosines, by row of the tables.
class SpecularColumns {
 public:
  static constexpr std::size_t kCount = 8;
  /// Of one roughness, by cosine.
  struct Albedos {
    std::array<float, kCount> constant{}, rising{};
  };

  explicit SpecularColumns(const std::array<double, kCount>& cosines);
  Albedos at(const TableCell& row) const;

 private:
  std::array<std::array<float, kCount>, kSpecularRows> constant_{}, rising_{};
};

/// The albedo for one roughness. Exact to 2e-4 for cosines above 0.1, to 2e-3 above 0.02, to 2e-2
/// below.
class SpecularCurve {
 public:
  SpecularCurve() = default;
  explicit SpecularCurve(double roughness) : row_(roughness, kSpecularRows) {}
  SpecularAlbedo at(double cosine) const { return at(albedo_column(cosine)); }
  SpecularAlbedo at(const TableCell& column) const;
  SpecularColumns::Albedos at(const SpecularColumns& columns) const { return columns.at(row_); }
  /// s of shader/multiple_scattering.hpp.
  double scale(double cosine) const;

 private:
  TableCell row_;
};

/// E of KHR_materials_sheen for one roughness and a sheen colour of 1. Exact to 2e-4 for cosines
/// above 0.1 and a roughness above 0.1.
class SheenCurve {
 public:
  SheenCurve() = default;
  explicit SheenCurve(double sheen_roughness) : row_(sheen_roughness, kSheenRows) {}
  double at(double cosine) const;

 private:
  TableCell row_;
};

/// The integral of (1 - V.H)^5 over a Lambertian lobe: its loss under Schlick's Fresnel.
inline double diffuse_fresnel(double cosine) {
  const double x = cosine;  // in a fit to integrate_diffuse_fresnel(), off by 8e-6 at most
  return 0.0281636625 +
         x * (-0.0798414128 + x * (0.0864126795 + x * (-0.0436042617 + x * 0.0089516657)));
}

/// Roughness of a row and cosine of a column; the first column is for a cosine just above 0.
constexpr double row_roughness(int row, int rows) { return row / (rows - 1.0); }
constexpr double column_cosine(int column) {
  const double root = column == 0 ? 0.02 : column / (kAlbedoColumns - 1.0);
  return root * root * root * root;
}

}  // namespace gltfx::shader
