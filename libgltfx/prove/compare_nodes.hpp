// SPDX-License-Identifier: Apache-2.0
/// Compares the places of nodes, their parents, and the meshes that they carry.
#pragma once

#include "prove/compare_values.hpp"

namespace gltfx::prove {

void compare_nodes(const Comparison& comparison, const Helpers& helpers);

}  // namespace gltfx::prove
