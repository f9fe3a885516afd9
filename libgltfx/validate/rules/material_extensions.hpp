// SPDX-License-Identifier: Apache-2.0
/// The rule table of the material extensions, which is too long to stand beside the rules.
#pragma once

#include <span>

#include "validate/context.hpp"

namespace gltfx::validate {

std::span<const RuleDescription> material_extension_rules();

}  // namespace gltfx::validate
