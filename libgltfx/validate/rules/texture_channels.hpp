// SPDX-License-Identifier: Apache-2.0
/// The table of the rules about channels of textures.
#pragma once

#include <span>

#include "validate/context.hpp"

namespace gltfx::validate {

std::span<const RuleDescription> texture_channel_rules();

}  // namespace gltfx::validate
