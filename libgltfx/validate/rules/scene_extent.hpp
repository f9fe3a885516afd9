// SPDX-License-Identifier: Apache-2.0
/// How large the default scene is, once there is data for its skins and instances.
#pragma once

#include "model/resource_data.hpp"
#include "validate/context.hpp"

namespace gltfx::validate {

/// Positions are in metres: a scene that is far too small or too large for that is reported.
void check_scene_extent(const Context& context, const model::ResourceData& resources, Sink& sink);

}  // namespace gltfx::validate
