// SPDX-License-Identifier: Apache-2.0
#include "shader/albedo.hpp"

#include "base/lanes.hpp"

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

// Sums of four neighbours of a row, over the rows of a cell.
template <class Rows>
Lanes weigh_rows(const Rows& rows, const TableCell& cell, std::size_t first) {
  Lanes sums{};
  for (std::size_t r = 0; r < cell.weights.size(); ++r) {
    sums += cell.weights[r] * load_lanes(rows[cell.first + r].data() + first);
  }
  return sums;
}

// Sum over the points that two cells take their values from.
template <class Rows>
double weigh(const Rows& rows, const TableCell& row, const TableCell& column) {
  const Lanes sums = weigh_rows(rows, row, column.first) * load_lanes(column.weights.data());
  return static_cast<double>(sum_of(sums));
}

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
    store_lanes(weigh_rows(constant_, row, first), albedos.constant.data() + first);
    store_lanes(weigh_rows(rising_, row, first), albedos.rising.data() + first);
  }
  return albedos;
}

SpecularAlbedo SpecularCurve::at(const TableCell& column) const {
  return {weigh(kSpecularConstant, row_, column), weigh(kSpecularRising, row_, column)};
}

double SpecularCurve::scale(double cosine) const {
  return weigh(kSpecularScale, row_, albedo_column(cosine));
}

double SheenCurve::at(double cosine) const {
  return weigh(kSheenAlbedo, row_, albedo_column(cosine));
}

}  // namespace gltfx::shader
