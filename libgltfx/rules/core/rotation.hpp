// SPDX-License-Identifier: Apache-2.0
/// Rotations of nodes and of other objects with a quaternion.
#pragma once

#include "rules/context.hpp"

namespace gltfx::validate {

/// An ObjectRule: checks that the quaternion in the member `rotation`, if there is one, has length
/// 1.
void check_rotation(const Context& context, json::NodeId object, const Path& path);

}  // namespace gltfx::validate
