// SPDX-License-Identifier: Apache-2.0
/// Rounds the numbers of vertex attributes to integers, within a bound.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "model/accessor.hpp"
#include "model/node.hpp"

namespace gltfx::steps {

/// Elements of an attribute as numbers, one after the other.
struct FloatElements {
  std::vector<float> values;
  unsigned width = 0;  ///< components of an element
};

/// Elements as integers.
struct IntegerElements {
  model::Format format;
  std::string bytes;  ///< packed
};

// Each function gives the smallest format within the bound; nothing: no format is, or a value is
// not one that the format can store.

/// Normals (3 components) or tangents (4, the last of which is 1 or -1). `bound`: degrees.
std::optional<IntegerElements> quantize_directions(const FloatElements& from, double bound);
/// Differences of normals or tangents by a morph target. `bound`: degrees that a difference of this
/// length turns a unit vector.
std::optional<IntegerElements> quantize_turns(const FloatElements& from, double bound);
/// Texture coordinates from 0 to 1. `bound`: of a component. `coarse`: only multiples of the
/// greatest power of two that keeps the bound, and the greatest integer, for entropy coders.
std::optional<IntegerElements> quantize_texcoords(const FloatElements& from, double bound,
                                                  bool coarse);
/// Colors from 0 to 1; bytes only if the values are those of bytes. Otherwise the same.
std::optional<IntegerElements> quantize_colors(const FloatElements& from, double bound,
                                               bool coarse);
/// Weights of all sets of a primitive. The integers of a vertex add up to 65535 unless all are 0.
std::optional<std::vector<IntegerElements>> quantize_weights(const std::vector<FloatElements>& sets,
                                                             double bound);

/// A lattice of positions: a power of two as the distance of its points, and a point of it.
struct Grid {
  double step = 1;
  model::Vector3 origin{};

  bool operator==(const Grid&) const = default;
};

/// Positions as points of a lattice. Nothing: a point is more than 65535 steps from the origin.
std::optional<IntegerElements> quantize_positions(const FloatElements& from, const Grid& grid);
/// Differences of positions by a morph target, in steps. Nothing: one has more than 32767.
std::optional<IntegerElements> quantize_moves(const FloatElements& from, double step);

}  // namespace gltfx::steps
