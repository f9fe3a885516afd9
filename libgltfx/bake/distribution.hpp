// SPDX-License-Identifier: Apache-2.0
/// Choosing points of a grid by the weights of its cells.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "bake/scene.hpp"

namespace gltfx::bake {

/// The unit square in rows, each in parts of equal probability within which all points are alike:
/// taking a point is two looks into tables, without a search. Every point has a density above 0.
class GridDistribution {
 public:
  GridDistribution() = default;
  /// `weights`: rows of `width`, finite and not negative. Weights that are all 0 count as equal.
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
  /// Lists of where each of `parts` parts of the probability begins, and where the last one ends.
  struct Quantiles {
    std::size_t parts = 1;  ///< a power of two
    std::vector<float> bounds;
    void add(std::span<const float> weights);
    const float* list(std::size_t number) const { return bounds.data() + number * (parts + 1); }
    /// The bound before a coordinate.
    const float* before(std::size_t number, float coordinate) const;
  };
  struct Choice {
    float coordinate = 0;
    float width = 1;  ///< of the part that it lies in, above 0
  };
  static Choice choose(const Quantiles& quantiles, std::size_t list, float random);
  std::size_t row_of(float coordinate) const;

  std::size_t height_ = 1;
  Quantiles rows_;
  Quantiles cells_;  ///< a list for each row
};

}  // namespace gltfx::bake
