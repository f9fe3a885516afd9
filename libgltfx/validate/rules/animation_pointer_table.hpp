// SPDX-License-Identifier: Apache-2.0
/// The rules on animation pointers in words; what checks them is in animation_pointer.cpp.
#pragma once

#include <gltfx/diagnostic.hpp>

#include <span>

namespace gltfx::validate {

std::span<const RuleDescription> animation_pointer_rules();

}  // namespace gltfx::validate
