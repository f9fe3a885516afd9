// SPDX-License-Identifier: Apache-2.0
/// Approximates texels by colours on a line, the endpoints and weights of a UASTC block.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "base/lanes.hpp"
#include "texel.hpp"
#include "uastc_levels.hpp"

namespace gltfx::codec {

/// A number of each texel of a block, in rows from the top.
inline constexpr std::size_t kLaneGroups = kBlockTexels / kLanes;
using TexelLanes = std::array<Lanes, kLaneGroups>;

/// R, G, B and A from 0 to 255.
using BlockLanes = std::array<TexelLanes, 4>;

/// Texels and channels that share endpoints and weights.
struct LineTexels {
  TexelLanes mask{};                       ///< 1: the texel belongs to them; else 0
  std::array<std::uint8_t, 4> channels{};  ///< the first `channel_count`
  std::uint8_t channel_count = 0;

  std::span<const std::uint8_t> used() const { return {channels.data(), channel_count}; }
};

/// Endpoints by channel, 0 to 255.
struct LineEnds {
  std::array<float, 4> low{}, high{};
};

/// Endpoints and weights of a subset in a plane.
struct UastcLine {
  std::array<std::array<std::uint8_t, 2>, 4> ranks{};  ///< of the levels, low and high, by channel
  std::array<std::uint8_t, kBlockTexels> weights{};    ///< also of texels outside of the subset
  float error = 0;                                     ///< sum of squares over texels and channels
};

/// The extent of the texels along their principal axis.
LineEnds extent_of(const BlockLanes& block, const LineTexels& texels);

/// Sum of the squared distances from the principal axis: no line has a smaller error, except by
/// chance of rounding.
float distance_from_axis(const BlockLanes& block, const LineTexels& texels);

/// Endpoints near `ends`, refined twice by least squares, and weights of `weight_bits`.
UastcLine fit_line(const BlockLanes& block, const LineTexels& texels, const LineEnds& ends,
                   const UastcLevels& levels, unsigned weight_bits);

}  // namespace gltfx::codec
