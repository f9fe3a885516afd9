// SPDX-License-Identifier: Apache-2.0
/// The table of the rules that look at decoded pixels.
#pragma once

#include <span>

#include "validate/context.hpp"

namespace gltfx::validate {

std::span<const RuleDescription> texture_pixel_rules();

}  // namespace gltfx::validate
