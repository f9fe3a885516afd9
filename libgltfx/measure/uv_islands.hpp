// SPDX-License-Identifier: Apache-2.0
/// Islands: the parts of an unwrapped surface.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "measure/uv_plane.hpp"

namespace gltfx::measure {

/// An edge with triangles on one of its sides only.
struct UvOutline {
  UvPoint from{}, to{};
  std::uint32_t island = 0;
};

struct UvIslands {
  std::size_t count = 0;
  std::vector<UvOutline> outlines;  ///< of all islands
};

/// Triangles with two equal corners are in one island. Linear, but for the sorting of edges at
/// corners that very many triangles share. Precondition: all triangles have an area and are finite.
UvIslands find_islands(const UvSurface& sound);

/// The texture that distances are measured in.
struct TexelGrid {
  double width = 0, height = 0;               ///< texels
  bool repeats_u = false, repeats_v = false;  ///< beyond the square from 0 to 1
};

/// Larger distances are not searched.
inline constexpr double kMostGutter = 64;

/// The least distance of outlines of two islands in texels, at most kMostGutter. Where the texture
/// repeats, also to copies in the next tiles. Nothing: out of a budget of work that is linear in
/// the outlines.
std::optional<double> find_gutter(std::span<const UvOutline> outlines, const TexelGrid& texels);

}  // namespace gltfx::measure
