// SPDX-License-Identifier: Apache-2.0
#include "base/suggestion.hpp"

#include "base/text.hpp"

namespace gltfx {

std::string did_you_mean(std::string_view word, std::span<const std::string_view> candidates) {
  const std::string_view near = nearest(word, candidates);
  return near.empty() ? std::string() : "; did you mean " + quoted(near) + "?";
}

}  // namespace gltfx
