// SPDX-License-Identifier: Apache-2.0
/// Reads bounds of losses from text.
#pragma once

#include <gltfx/loss_bounds.hpp>

#include <string_view>

#include "base/result.hpp"

namespace gltfx {

/// Reads a list such as "position=0.01%,normal=0.5deg,color=off". Bounds that are not in the list
/// have their defaults. Returns an Error (half a sentence) with the nearest name if a name is
/// unknown.
Result<LossBounds> parse_loss_bounds(std::string_view text);

}  // namespace gltfx
