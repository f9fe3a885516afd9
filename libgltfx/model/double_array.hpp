// SPDX-License-Identifier: Apache-2.0
/// Arrays of numbers in the precision in which they are written.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <optional>

#include "json/document.hpp"

namespace gltfx::model {

/// Exactly N finite numbers of an array, or nothing when it is absent or malformed.
template <std::size_t N>
std::optional<std::array<double, N>> double_array(const json::Document& document,
                                                  json::NodeId array) {
  if (array == json::kNoNode || document.kind(array) != json::Kind::number_array ||
      document.array_size(array) != N) {
    return std::nullopt;
  }
  std::array<double, N> values{};
  std::size_t i = 0;
  for (json::NumberCursor at(document, array); at.valid(); at.advance()) {
    values[i] = at.number().value;
    if (!std::isfinite(values[i++])) return std::nullopt;
  }
  return values;
}

}  // namespace gltfx::model
