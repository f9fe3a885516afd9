// SPDX-License-Identifier: Apache-2.0
/// The area of what a scene draws.
#pragma once

#include "measure/take.hpp"

namespace gltfx::measure {

/// Takes surface-area of all scenes.
void take_scene_areas(Taking& taking, Column& column);

}  // namespace gltfx::measure
