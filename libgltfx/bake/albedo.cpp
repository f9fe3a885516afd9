// SPDX-License-Identifier: Apache-2.0
#include "bake/albedo.hpp"

#include <algorithm>
#include <cmath>

namespace gltfx::bake {
namespace {

// Sum over the points that two cells take their values from, four at a time.
double weigh(const AlbedoRow* table, const TableCell& row, const TableCell& column) {
  std::array<float, 4> sums{};
  for (std::size_t r = 0; r < 4; ++r) {
    const float* values = table[row.first + r].data() + column.first;
    for (std::size_t c = 0; c < 4; ++c) sums[c] += row.weights[r] * values[c];
  }
  const auto& w = column.weights;
  return static_cast<double>((sums[0] * w[0] + sums[1] * w[1]) + (sums[2] * w[2] + sums[3] * w[3]));
}

}  // namespace

TableCell::TableCell(double x, int size) {
  const auto scaled = static_cast<float>(std::clamp(x, 0.0, 1.0)) * static_cast<float>(size - 1);
  const int cell = std::min(static_cast<int>(scaled), size - 2);
  const float t = scaled - static_cast<float>(cell);
  const float a = t * (-0.5F + t * (1 - 0.5F * t));
  const float b = 1 + t * t * (-2.5F + 1.5F * t);
  const float c = t * (0.5F + t * (2 - 1.5F * t));
  const float d = t * t * (-0.5F + 0.5F * t);
  first = static_cast<std::size_t>(std::clamp(cell - 1, 0, size - 4));
  if (cell == 0) {
    weights = {b + 2 * a, c - a, d, 0};
  } else if (cell == size - 2) {
    weights = {0, a, b - d, c + 2 * d};
  } else {
    weights = {a, b, c, d};
  }
}

TableCell albedo_column(double cosine) { return {std::sqrt(std::sqrt(cosine)), kAlbedoColumns}; }

SpecularColumn::SpecularColumn(double cosine) {
  const TableCell column = albedo_column(cosine);
  for (std::size_t row = 0; row < constant_.size(); ++row) {
    for (std::size_t c = 0; c < column.weights.size(); ++c) {
      constant_[row] += column.weights[c] * kSpecularConstant[row][column.first + c];
      rising_[row] += column.weights[c] * kSpecularRising[row][column.first + c];
    }
  }
}

SpecularAlbedo SpecularColumn::at(const TableCell& row) const {
  float constant = 0;
  float rising = 0;
  for (std::size_t r = 0; r < row.weights.size(); ++r) {
    constant += row.weights[r] * constant_[row.first + r];
    rising += row.weights[r] * rising_[row.first + r];
  }
  return {static_cast<double>(constant), static_cast<double>(rising)};
}

SpecularAlbedo SpecularCurve::at(const TableCell& column) const {
  return {weigh(kSpecularConstant.data(), row_, column),
          weigh(kSpecularRising.data(), row_, column)};
}

double SheenCurve::at(double cosine) const {
  return weigh(kSheenAlbedo.data(), row_, albedo_column(cosine));
}

double diffuse_fresnel(double x) {
  // A fit to integrate_diffuse_fresnel(), off by 8e-6 at most.
  return 0.0281636625 +
         x * (-0.0798414128 + x * (0.0864126795 + x * (-0.0436042617 + x * 0.0089516657)));
}

}  // namespace gltfx::bake
