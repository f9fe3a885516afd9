// SPDX-License-Identifier: Apache-2.0
/// The rules of packed_geometry.cpp in words.
#pragma once

#include <gltfx/diagnostic.hpp>

#include <span>

namespace gltfx::validate {

std::span<const RuleDescription> packed_geometry_rules();

}  // namespace gltfx::validate
