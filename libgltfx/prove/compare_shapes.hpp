// SPDX-License-Identifier: Apache-2.0
/// Compares the meshes that matched nodes carry, and skins.
#pragma once

#include <vector>

#include "prove/compare_values.hpp"

namespace gltfx::prove {

/// `moved`, by node of the old asset: gets whether the node is placed differently, and its mesh
/// does not undo that.
void compare_shapes(const Comparison& comparison, const Helpers& helpers, std::vector<bool>& moved);

}  // namespace gltfx::prove
