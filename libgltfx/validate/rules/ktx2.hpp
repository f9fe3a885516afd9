// SPDX-License-Identifier: Apache-2.0
/// The table of the rules about KTX2 images.
#pragma once

#include <span>

#include "validate/context.hpp"

namespace gltfx::validate {

std::span<const RuleDescription> ktx2_rules();

}  // namespace gltfx::validate
