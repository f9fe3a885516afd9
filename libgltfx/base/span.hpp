// SPDX-License-Identifier: Apache-2.0
/// A range of a text, as byte offsets.
#pragma once

#include <cstdint>
#include <string_view>

namespace gltfx {

/// Half-open range of bytes [begin, end) in a text of less than 4 GiB.
struct Span {
  std::uint32_t begin = 0;
  std::uint32_t end = 0;

  constexpr std::uint32_t size() const { return end - begin; }
  constexpr bool empty() const { return begin == end; }
  std::string_view in(std::string_view text) const { return text.substr(begin, size()); }
  friend constexpr bool operator==(const Span&, const Span&) = default;
};

}  // namespace gltfx
