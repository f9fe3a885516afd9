// SPDX-License-Identifier: Apache-2.0
#include "bake/albedo.hpp"

#include "bake/lanes.hpp"

namespace gltfx::bake {
namespace {

// Sum over the points that two cells take their values from.
double weigh(const AlbedoRow* table, const TableCell& row, const TableCell& column) {
  Lanes sums{};
  for (std::size_t r = 0; r < 4; ++r) {
    sums += row.weights[r] * load_lanes(table[row.first + r].data() + column.first);
  }
  return static_cast<double>(sum_of(sums * load_lanes(column.weights.data())));
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
  const auto mean = [&](const auto& table, std::size_t first) {
    Lanes sums{};
    for (std::size_t r = 0; r < row.weights.size(); ++r) {
      sums += row.weights[r] * load_lanes(table[row.first + r].data() + first);
    }
    return sums;
  };
  Albedos albedos;
  for (std::size_t first = 0; first < kCount; first += kLanes) {
    store_lanes(mean(constant_, first), albedos.constant.data() + first);
    store_lanes(mean(rising_, first), albedos.rising.data() + first);
  }
  return albedos;
}

SpecularAlbedo SpecularCurve::at(const TableCell& column) const {
  return {weigh(kSpecularConstant.data(), row_, column),
          weigh(kSpecularRising.data(), row_, column)};
}

double SheenCurve::at(double cosine) const {
  return weigh(kSheenAlbedo.data(), row_, albedo_column(cosine));
}

}  // namespace gltfx::bake
