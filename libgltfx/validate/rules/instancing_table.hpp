// SPDX-License-Identifier: Apache-2.0
/// The rules of instancing.cpp in words.
#pragma once

#include <gltfx/diagnostic.hpp>

#include <span>

namespace gltfx::validate {

std::span<const RuleDescription> instancing_rules();

}  // namespace gltfx::validate
