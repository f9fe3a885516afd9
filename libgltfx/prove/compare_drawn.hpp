// SPDX-License-Identifier: Apache-2.0
/// Compares what both assets draw, whichever nodes and meshes it is made of.
#pragma once

#include "prove/changes.hpp"

namespace gltfx::prove {

/// If all surfaces that never move are the same in the scene, or within bounds, changes of the
/// nodes and meshes that only they are made of are removed from the log: such as of meshes that
/// were joined. Scenes of more than a few million corners are left as they are.
void forget_static_surfaces(const Comparison& comparison);

}  // namespace gltfx::prove
