// SPDX-License-Identifier: Apache-2.0
/// The rules on skins in words; what checks them is in skin.cpp.
#pragma once

#include <gltfx/diagnostic.hpp>

#include <span>

namespace gltfx::validate {

std::span<const RuleDescription> skin_rules();

}  // namespace gltfx::validate
