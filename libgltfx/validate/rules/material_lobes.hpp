// SPDX-License-Identifier: Apache-2.0
/// The table of the rules about lobes of materials that hide each other or are switched off.
#pragma once

#include <span>

#include "validate/context.hpp"

namespace gltfx::validate {

std::span<const RuleDescription> material_lobe_rules();

}  // namespace gltfx::validate
