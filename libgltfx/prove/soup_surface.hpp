// SPDX-License-Identifier: Apache-2.0
/// Compares triangles that have no counterparts as surfaces.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "model/surface_distance.hpp"
#include "prove/soup_pair.hpp"

namespace gltfx::prove {

/// How near two surfaces are to each other.
struct SurfaceCloseness {
  std::vector<double> greatest;  ///< by stream, as StreamDistance::greatest
  model::Vector3 at{};           ///< where the positions are farthest apart
};

/// If each point of either surface is near a point of the other one that faces the same way, with
/// all its values: within SoupScale::limits. Each triangle is cut along the edges of those that it
/// lies on, and each piece is compared at its corners, where a flat piece over a flat triangle is
/// farthest. Over gaps, pieces are halved until they are half as large as the limit of positions,
/// which is added. Nothing: they are not near, or it would take too long.
/// `left`: elements. Preconditions: equal streams; soups of triangles.
std::optional<SurfaceCloseness> match_surfaces(const Soup& ours,
                                               const std::vector<std::uint32_t>& left,
                                               const Soup& theirs,
                                               const std::vector<std::uint32_t>& their_left,
                                               const SoupScale& scale);

/// The greatest distance of both surfaces in the space of the soups, and where it is. Nothing: one
/// of them is empty or not finite, or it would take too long.
std::optional<model::SurfaceDistance> surface_distance_of(
    const Soup& ours, const std::vector<std::uint32_t>& left, const Soup& theirs,
    const std::vector<std::uint32_t>& their_left);

}  // namespace gltfx::prove
