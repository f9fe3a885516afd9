// SPDX-License-Identifier: Apache-2.0
/// Weighted least squares of first order, for adjacent pixels.
#pragma once

#include <array>
#include <cstddef>

namespace gltfx::render {

/// Normal equations of `Pixels` pixels: sums of products of the terms of neighbours, and of the
/// terms with the values.
template <std::size_t Terms, std::size_t Pixels>
struct NormalEquations {
  using Row = std::array<float, Pixels>;  ///< a number for each pixel
  static constexpr std::size_t kProducts = Terms * (Terms + 1) / 2;
  std::array<Row, kProducts> products{};  ///< lower triangle, row by row
  std::array<std::array<Row, Terms>, 3> colors{};

  /// Sets `values`, by channel, to those at the pixels themselves, where all terms but the first
  /// are 0; leaves them where the weight is 0. `ridge`: regularisation of the slopes, relative to
  /// the weight.
  void solve(float ridge, std::array<Row, 3>& values) const {
    std::array<Row, kProducts> root;
    const Row solvable = factor(ridge, root);
    const std::array<Row, Terms> influence = first_row_of_inverse(root);
    for (std::size_t c = 0; c < 3; ++c) {
      Row sum{};
      for (std::size_t i = 0; i < Terms; ++i) {
        for (std::size_t x = 0; x < Pixels; ++x) sum[x] += influence[i][x] * colors[c][i][x];
      }
      for (std::size_t x = 0; x < Pixels; ++x)
        values[c][x] = solvable[x] > 0 ? sum[x] : values[c][x];
    }
  }

 private:
  static constexpr float kFew = 0.05F;  // regularises where there are few neighbours

  static constexpr std::size_t at(std::size_t row, std::size_t column) {
    return row * (row + 1) / 2 + column;
  }

  static void subtract_product(const Row& a, const Row& b, Row& from) {
    for (std::size_t x = 0; x < Pixels; ++x) from[x] -= a[x] * b[x];
  }

  static void divide(const Row& a, const Row& b, Row& quotient) {
    for (std::size_t x = 0; x < Pixels; ++x) quotient[x] = a[x] / b[x];
  }

  // Cholesky's decomposition. Returns 1 for each pixel, or 0 if there is none and the root is
  // undefined.
  Row factor(float ridge, std::array<Row, kProducts>& root) const {
    Row solvable;
    solvable.fill(1);
    for (std::size_t i = 0; i < Terms; ++i) {
      for (std::size_t j = 0; j < i; ++j) {
        Row sum = products[at(i, j)];
        for (std::size_t k = 0; k < j; ++k) subtract_product(root[at(i, k)], root[at(j, k)], sum);
        divide(sum, root[at(j, j)], root[at(i, j)]);
      }
      Row sum = products[at(i, i)];
      for (std::size_t x = 0; x < Pixels && i > 0; ++x) sum[x] += ridge * products[0][x] + kFew;
      for (std::size_t k = 0; k < i; ++k) subtract_product(root[at(i, k)], root[at(i, k)], sum);
      for (std::size_t x = 0; x < Pixels; ++x) {
        solvable[x] = sum[x] > 0 ? solvable[x] : 0;
        root[at(i, i)][x] = __builtin_sqrtf(sum[x] > 0 ? sum[x] : 1);
      }
    }
    return solvable;
  }

  static std::array<Row, Terms> first_row_of_inverse(const std::array<Row, kProducts>& root) {
    std::array<Row, Terms> y{};
    y[0].fill(1);
    for (std::size_t i = 0; i < Terms; ++i) {
      for (std::size_t k = 0; k < i; ++k) subtract_product(root[at(i, k)], y[k], y[i]);
      divide(y[i], root[at(i, i)], y[i]);
    }
    for (std::size_t i = Terms; i-- > 0;) {
      for (std::size_t k = i + 1; k < Terms; ++k) subtract_product(root[at(k, i)], y[k], y[i]);
      divide(y[i], root[at(i, i)], y[i]);
    }
    return y;
  }
};

}  // namespace gltfx::render
