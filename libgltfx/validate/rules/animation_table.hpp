// SPDX-License-Identifier: Apache-2.0
/// The rules on animations in words; what checks them is in animation.cpp.
#pragma once

#include <gltfx/diagnostic.hpp>

#include <span>

namespace gltfx::validate {

std::span<const RuleDescription> animation_rules();

}  // namespace gltfx::validate
