// SPDX-License-Identifier: Apache-2.0
/// The table of the rules about slots that share an image.
#pragma once

#include <span>

#include "validate/context.hpp"

namespace gltfx::validate {

std::span<const RuleDescription> texture_sharing_rules();

}  // namespace gltfx::validate
