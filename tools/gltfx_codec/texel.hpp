// SPDX-License-Identifier: Apache-2.0
/// Texels of decoded blocks of 4 by 4.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace gltfx::codec {

using Texel = std::array<std::uint8_t, 4>;  ///< R, G, B and A

inline constexpr std::size_t kAlpha = 3;

inline constexpr std::size_t kBlockExtent = 4;
inline constexpr std::size_t kBlockTexels = kBlockExtent * kBlockExtent;

constexpr std::size_t blocks_along(std::size_t texels) {
  return (texels + kBlockExtent - 1) / kBlockExtent;
}

/// A block of an image in memory: its upper left texel, and the number of texels per row.
struct BlockTexels {
  Texel* first;
  std::size_t stride;
  Texel& at(std::size_t x, std::size_t y) const { return first[y * stride + x]; }
};

}  // namespace gltfx::codec
