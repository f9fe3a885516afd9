// SPDX-License-Identifier: Apache-2.0
/// Choosing the cells of a grid by their weights.
#pragma once

#include <cstddef>
#include <vector>

#include "bake/scene.hpp"

namespace gltfx::bake {

/// Piecewise constant over the unit square. Weights that are all 0 count as equal.
class GridDistribution {
 public:
  GridDistribution() = default;
  /// `weights`: rows of `width`, finite and not negative.
  GridDistribution(std::size_t width, std::vector<float> weights);

  /// A point of the unit square by an even one.
  Float2 sample(const Float2& random) const;
  /// Density at a point of the unit square; 1 on average.
  double density(const Float2& point) const;

 private:
  std::size_t width_ = 1;
  std::vector<float> rows_;   // running sums of the rows' weights, ending in 1
  std::vector<float> cells_;  // row by row running sums within the row, ending in 1
};

}  // namespace gltfx::bake
