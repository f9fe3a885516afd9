// SPDX-License-Identifier: Apache-2.0
/// Fewer triangles for a surface, by the collapse of edges (meshoptimizer).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "model/surface_tree.hpp"

namespace gltfx::model {

/// A surface to simplify. Vertices with equal positions are the sides of a seam, which stays shut.
struct SimplifyRequest {
  Surface surface;
  std::size_t triangles = 0;  ///< it stops there
  double error = 0;           ///< an estimate of the distance, in the unit of positions
  bool lock_borders = false;  ///< vertices of open borders stay
};

/// The corners of the triangles that remain: vertices of the surface. Preconditions: all positions
/// are finite, and the request is affordable().
std::vector<std::uint32_t> simplify(const SimplifyRequest& request);

/// Whether the time is bounded by the number of triangles: it grows with the square of the number
/// of triangles at a vertex. `points`: for each vertex, the first one with the same position.
bool is_affordable(const Surface& surface, std::span<const std::uint32_t> points);

/// The edges of a surface without a second triangle in the other direction, by the numbers of
/// `points`, sorted: pairs of vertices.
std::vector<std::array<std::uint32_t, 2>> open_edges(std::span<const std::uint32_t> corners,
                                                     std::span<const std::uint32_t> points);

}  // namespace gltfx::model
