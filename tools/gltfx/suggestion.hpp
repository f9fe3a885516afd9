// SPDX-License-Identifier: Apache-2.0
/// Suggestions for words of the command line.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "base/text.hpp"

namespace gltfx::tool {

/// " Did you mean 'x'?" with the candidate nearest to `word`, or empty when none is near.
inline std::string suggestion(std::string_view word, std::span<const std::string_view> candidates) {
  const std::string_view near = nearest(word, candidates);
  return near.empty() ? std::string() : " Did you mean " + quoted(near) + "?";
}

}  // namespace gltfx::tool
