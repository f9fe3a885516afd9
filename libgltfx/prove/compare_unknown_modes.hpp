// SPDX-License-Identifier: Apache-2.0
/// Compares primitives of modes that glTF does not have.
#pragma once

#include <vector>

#include "prove/compare_surfaces.hpp"

namespace gltfx::prove {

/// Compares the values of all vertices and indices in order, if no primitive has a mode of glTF.
/// False: there are others, or not all values can be read.
bool compare_unknown_modes(const Comparison& comparison, const SurfacePair& pair,
                           std::vector<Change>& changes);

}  // namespace gltfx::prove
