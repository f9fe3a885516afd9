// SPDX-License-Identifier: Apache-2.0
/// Values between those of tables.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "base/lanes.hpp"

namespace gltfx::shader {

/// Four neighbours in a table of values over [0, 1], and the weights of a cubic curve through them
/// (Catmull and Rom); at the ends it is extrapolated linearly.
struct TableCell {
  std::size_t first = 0;
  std::array<float, 4> weights{};

  TableCell() = default;
  TableCell(double x, int size) : TableCell(static_cast<float>(x), size) {}
  TableCell(float x, int size) {
    const float scaled = std::clamp(x, 0.0F, 1.0F) * static_cast<float>(size - 1);
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
};

/// The place of a cosine in a table by its fourth root.
inline TableCell cosine_column(double cosine, int size) {
  return {std::sqrt(std::sqrt(static_cast<float>(cosine))), size};
}

/// The value of a row at a place.
template <class Row>
double interpolated(const Row& row, const TableCell& column) {
  return static_cast<double>(
      sum_of(load_lanes(row.data() + column.first) * load_lanes(column.weights.data())));
}

/// Four columns, from `first` on, between the rows of a table.
template <class Rows>
Lanes interpolated_lanes(const Rows& rows, const TableCell& row, std::size_t first) {
  Lanes sums{};
  for (std::size_t r = 0; r < row.weights.size(); ++r)
    sums += row.weights[r] * load_lanes(rows[row.first + r].data() + first);
  return sums;
}

/// The value of a table at a place.
template <class Rows>
double interpolated(const Rows& rows, const TableCell& row, const TableCell& column) {
  const Lanes values = interpolated_lanes(rows, row, column.first);
  return static_cast<double>(sum_of(values * load_lanes(column.weights.data())));
}

}  // namespace gltfx::shader
