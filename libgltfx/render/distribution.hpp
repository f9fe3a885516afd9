// SPDX-License-Identifier: Apache-2.0
/// Sampling of a piecewise constant function of two dimensions.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "render/scene.hpp"

namespace gltfx::render {

/// A distribution over the cells of the unit square, in rows of parts of equal probability. If the
/// weights of a part are nearly equal, its density is constant, and sampling reads a table;
/// otherwise it searches for the cell. Weights that are all 0 count as equal.
class PiecewiseConstant2d {
 public:
  PiecewiseConstant2d() = default;
  /// `weights`: rows of `width`, finite and not negative. `alike`: the ratio up to which weights
  /// count as equal; with 1 the density is constant in each cell.
  PiecewiseConstant2d(std::size_t width, std::span<const float> weights, float alike = 1);

  struct Sample {
    Float2 point{};
    double density = 0;  ///< at the point
  };
  /// `random`: uniform in the unit square.
  Sample sample(const Float2& random) const;
  /// Density at a point of the unit square; 1 on average.
  double density(const Float2& point) const;

 private:
  struct Choice {
    float coordinate = 0;
    float spread = 1;  ///< one over the density
  };
  /// Lists of `count` weights each.
  struct Lists {
    std::size_t count = 1, parts = 1;  ///< the latter a power of two
    std::vector<float> sums;           ///< running, from 0 to 1: count + 1 of each list
    /// Starts of the parts and end of the last one; negative (also -0) where weights differ.
    std::vector<float> bounds;

    void add(std::span<const float> weights, float alike);
    void add_bounds(std::span<const float> probabilities, float alike);
    std::size_t cell_of(float coordinate) const;
    Choice choose(std::size_t list, float random) const;
    Choice search(std::size_t list, float random) const;
    float spread(std::size_t list, float coordinate) const;
  };

  Lists rows_;
  Lists cells_;  ///< a list for each row
};

}  // namespace gltfx::render
