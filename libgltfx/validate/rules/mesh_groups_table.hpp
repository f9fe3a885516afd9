// SPDX-License-Identifier: Apache-2.0
/// The rules of mesh_groups.cpp in words.
#pragma once

#include <gltfx/diagnostic.hpp>

#include <span>

namespace gltfx::validate {

std::span<const RuleDescription> mesh_groups_rules();

}  // namespace gltfx::validate
