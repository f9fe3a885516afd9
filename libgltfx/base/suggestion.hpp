// SPDX-License-Identifier: Apache-2.0
/// A suggestion for a misspelt word, as a clause of a message.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace gltfx {

/// "; did you mean 'x'?" with the nearest candidate, or empty.
std::string did_you_mean(std::string_view word, std::span<const std::string_view> candidates);

}  // namespace gltfx
