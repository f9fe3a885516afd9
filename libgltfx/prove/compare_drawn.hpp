// SPDX-License-Identifier: Apache-2.0
/// Compares what both assets draw, whichever nodes and meshes it is made of.
#pragma once

#include "prove/changes.hpp"

namespace gltfx::prove {

/// If all surfaces without skins and morph targets are the same in the scene, or within bounds, at
/// rest and at keyframes, changes of the nodes, meshes and animations that only they are made of
/// are removed from the log: such as of meshes that were joined. If they are not, and nodes were
/// replaced by others, what differs in the scene stands for these changes. Scenes of more than a
/// few million corners are left as they are.
void compare_drawn(const Comparison& comparison);

}  // namespace gltfx::prove
