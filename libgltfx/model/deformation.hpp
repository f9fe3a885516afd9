// SPDX-License-Identifier: Apache-2.0
/// Morph targets and skins applied to vertices (specification sections 3.7.2.2 and 3.7.3).
#pragma once

#include <span>

#include "model/geometry.hpp"

namespace gltfx::model {

/// Adds the morph targets by their weights. Targets with weight 0 or unreadable data have no
/// effect.
void morph(const PrimitiveData& data, std::span<const float> weights,
           std::span<const std::uint32_t> tex_coords, Geometry& geometry);

/// Moves vertices with their joints. Weights are normalized to a sum of 1; a vertex without weights
/// follows its first joint. False, and no effect, if joints or weights cannot be read.
bool skin(const PrimitiveData& data, std::span<const Affine> joints, Geometry& geometry);

}  // namespace gltfx::model
