// SPDX-License-Identifier: Apache-2.0
/// The size of a scene, as the unit of distances.
#pragma once

#include "model/geometry.hpp"
#include "model/pose.hpp"

namespace gltfx::model {

/// Length of the diagonal of the box of what a scene draws at rest; 0 if it draws nothing. If
/// vertices cannot be read, or if there are too many of them, the box is that of the declared
/// bounds of accessors.
double scene_diagonal(const GeometrySource& source, const Pose& pose);

}  // namespace gltfx::model
