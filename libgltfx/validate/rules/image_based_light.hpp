// SPDX-License-Identifier: Apache-2.0
/// The images of environment lights, once their headers have been read.
#pragma once

#include "model/resource_data.hpp"
#include "validate/context.hpp"

namespace gltfx::validate {

/// EXT_lights_image_based: faces of cubes are square, of a power of two, and halve from level to
/// level, beginning with the size that the light states.
void check_image_based_lights(const Context& context, const model::ResourceData& resources,
                              Sink& sink);

}  // namespace gltfx::validate
