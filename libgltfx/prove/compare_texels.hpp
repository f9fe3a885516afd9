// SPDX-License-Identifier: Apache-2.0
/// Compares images by the channels that materials read.
#pragma once

#include "prove/changes.hpp"

namespace gltfx::prove {

void compare_image_texels(const Comparison& comparison);

}  // namespace gltfx::prove
