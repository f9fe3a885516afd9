// SPDX-License-Identifier: Apache-2.0
/// Weighted least squares of first order, for many pixels side by side.
#pragma once

#include <array>
#include <cstddef>

#include "bake/scene.hpp"

namespace gltfx::bake {

/// Sums of the normal equations of one pixel: products of the terms of neighbours, and of the terms
/// with the values.
template <std::size_t Terms>
struct NormalEquations {
  static constexpr std::size_t kProducts = Terms * (Terms + 1) / 2;
  std::array<float, kProducts> products{};  ///< lower triangle, row by row
  std::array<std::array<float, Terms>, 3> colors{};

  /// The value at the pixel itself, where all terms but the first are 0. `ridge`: regularisation of
  /// the slopes, relative to the weight. False, and no value, if the weight is 0.
  bool solve(float ridge, Float3& value) const {
    std::array<float, kProducts> root{};
    if (!factor(ridge, root)) return false;
    const std::array<float, Terms> influence = first_row_of_inverse(root);
    for (std::size_t c = 0; c < 3; ++c) {
      value[c] = 0;
      for (std::size_t i = 0; i < Terms; ++i) value[c] += influence[i] * colors[c][i];
    }
    return true;
  }

 private:
  static constexpr float kFew = 0.05F;  // regularises where there are few neighbours

  static constexpr std::size_t at(std::size_t row, std::size_t column) {
    return row * (row + 1) / 2 + column;
  }

  // Cholesky's decomposition.
  bool factor(float ridge, std::array<float, kProducts>& root) const {
    const float weight = products[0];
    if (!(weight > 0)) return false;
    for (std::size_t i = 0; i < Terms; ++i) {
      for (std::size_t j = 0; j <= i; ++j) {
        float sum = products[at(i, j)];
        if (i == j && i > 0) sum += ridge * weight + kFew;
        for (std::size_t k = 0; k < j; ++k) sum -= root[at(i, k)] * root[at(j, k)];
        if (i == j) {
          if (!(sum > 0)) return false;
          root[at(i, i)] = __builtin_sqrtf(sum);
        } else {
          root[at(i, j)] = sum / root[at(j, j)];
        }
      }
    }
    return true;
  }

  static std::array<float, Terms> first_row_of_inverse(const std::array<float, kProducts>& root) {
    std::array<float, Terms> y{};
    for (std::size_t i = 0; i < Terms; ++i) {
      float sum = i == 0 ? 1.0F : 0.0F;
      for (std::size_t k = 0; k < i; ++k) sum -= root[at(i, k)] * y[k];
      y[i] = sum / root[at(i, i)];
    }
    std::array<float, Terms> x{};
    for (std::size_t i = Terms; i-- > 0;) {
      float sum = y[i];
      for (std::size_t k = i + 1; k < Terms; ++k) sum -= root[at(k, i)] * x[k];
      x[i] = sum / root[at(i, i)];
    }
    return x;
  }
};

}  // namespace gltfx::bake
