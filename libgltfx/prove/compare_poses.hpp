// SPDX-License-Identifier: Apache-2.0
/// Compares skinned meshes in the poses of the animations.
#pragma once

#include "prove/changes.hpp"

namespace gltfx::prove {

/// Joints, weights, matrices and curves that are each within bounds may move vertices farther
/// together. If all changes of geometry, skins, places and curves so far are within bounds, the
/// vertices of each skin are compared at rest and at up to 64 times of keyframes of each
/// animation, in the scene.
void compare_poses(const Comparison& comparison);

}  // namespace gltfx::prove
