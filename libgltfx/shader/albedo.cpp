// SPDX-License-Identifier: Apache-2.0
#include "shader/albedo.hpp"

namespace gltfx::shader {
namespace {

using AlbedoRow = std::array<float, kAlbedoColumns>;
constexpr std::array<AlbedoRow, kSpecularRows> kSpecularConstant{{
#include "shader/tables/specular_constant.inc"
}};
constexpr std::array<AlbedoRow, kSpecularRows> kSpecularRising{{
#include "shader/tables/specular_rising.inc"
}};
constexpr std::array<AlbedoRow, kSpecularRows> kSpecularScale{{
#include "shader/tables/specular_scale.inc"
}};
constexpr std::array<AlbedoRow, kSheenRows> kSheenAlbedo{{
#include "shader/tables/sheen_albedo.inc"
}};

}  // namespace

SpecularColumns::SpecularColumns(const std::array<double, kCount>& cosines) {
  for (std::size_t i = 0; i < kCount; ++i) {
    const TableCell column = albedo_column(cosines[i]);
    for (std::size_t row = 0; row < kSpecularRows; ++row) {
      for (std::size_t c = 0; c < column.weights.size(); ++c) {
        constant_[row][i] += column.weights[c] * kSpecularConstant[row][column.first + c];
        rising_[row][i] += column.weights[c] * kSpecularRising[row][column.first + c];
      }
    }
  }
}

SpecularColumns::Albedos SpecularColumns::at(const TableCell& row) const {
  Albedos albedos;
  for (std::size_t first = 0; first < kCount; first += kLanes) {
    store_lanes(interpolated_lanes(constant_, row, first), albedos.constant.data() + first);
    store_lanes(interpolated_lanes(rising_, row, first), albedos.rising.data() + first);
  }
  return albedos;
}

SpecularAlbedo SpecularCurve::at(const TableCell& column) const {
  return {interpolated(kSpecularConstant, row_, column),
          interpolated(kSpecularRising, row_, column)};
}

double SpecularCurve::scale(double cosine) const {
  return interpolated(kSpecularScale, row_, albedo_column(cosine));
}

double SheenCurve::at(double cosine) const {
  return interpolated(kSheenAlbedo, row_, albedo_column(cosine));
}

}  // namespace gltfx::shader
