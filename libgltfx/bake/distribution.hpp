// SPDX-License-Identifier: Apache-2.0
/// Choosing the cells of a grid by their weights.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
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
  /// Running sums of weights, ending in 1, and where a search in them may begin.
  struct Steps {
    std::vector<float> sums;
    std::vector<std::uint32_t> guide;
    void add(std::span<const float> weights);
  };
  struct Choice {
    std::size_t index = 0;
    float within = 0;  ///< between the sums before and after
  };
  static Choice choose(const Steps& steps, std::size_t first, std::size_t count, float random);
  static float probability(const Steps& steps, std::size_t first, std::size_t index);

  std::size_t width_ = 1;
  Steps rows_;
  Steps cells_;  ///< row by row, each from 0 to 1
};

}  // namespace gltfx::bake
