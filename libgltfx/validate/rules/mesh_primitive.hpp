// SPDX-License-Identifier: Apache-2.0
/// The rule table of primitives, which is too long to stand beside the rules.
#pragma once

#include <span>

#include "validate/context.hpp"

namespace gltfx::validate {

std::span<const RuleDescription> mesh_primitive_rules();

}  // namespace gltfx::validate
