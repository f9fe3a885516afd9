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
  GridDistribution(std::size_t width, std::span<const float> weights);

  struct Sample {
    Float2 point{};
    double density = 0;  ///< there
  };
  /// A point of the unit square by an even one.
  Sample sample(const Float2& random) const;
  /// Density at a point of the unit square; 1 on average.
  double density(const Float2& point) const;

 private:
  /// Lists of `count` weights: running sums, each list from 0 to 1, and where a search begins.
  struct Steps {
    std::size_t count = 0;
    std::vector<float> sums;           ///< count + 1 of each list
    std::vector<std::uint32_t> guide;  ///< count of each list
    void add(std::span<const float> weights);
    float probability(std::size_t list, std::size_t index) const;
  };
  struct Choice {
    std::size_t index = 0;
    float within = 0;       ///< of the step, below 1
    float probability = 0;  ///< above 0
  };
  static Choice choose(const Steps& steps, std::size_t list, float random);

  std::size_t width_ = 1;
  Steps rows_;
  Steps cells_;  ///< a list for each row
};

}  // namespace gltfx::bake
