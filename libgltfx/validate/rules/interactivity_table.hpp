// SPDX-License-Identifier: Apache-2.0
/// The rules of interactivity.cpp in words.
#pragma once

#include <gltfx/diagnostic.hpp>

#include <span>

namespace gltfx::validate {

std::span<const RuleDescription> interactivity_rules();

}  // namespace gltfx::validate
