// SPDX-License-Identifier: Apache-2.0
/// Finds pixels near edges, of which few samples may see one side only.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "render/bvh.hpp"
#include "render/render.hpp"
#include "render/view.hpp"

namespace gltfx::render {

/// Edges between bodies (Hit::body) in one tile of a picture.
class EdgeMap {
 public:
  /// Casts a ray through the centre of each pixel of the tile and around it. `left`, `top`: its
  /// first pixel.
  EdgeMap(const Bvh& bvh, const View& view, const RenderOptions& options, std::uint32_t left,
          std::uint32_t top);

  /// Whether the centres of a pixel and its eight neighbours, which surround all samples of the
  /// pixel, do not all show the same body, or all nothing. Details smaller than a pixel may be
  /// missed.
  bool is_near_edge(std::uint32_t x, std::uint32_t y) const;

 private:
  static constexpr std::uint32_t kColumns = kTileWidth + 2, kRows = kTileHeight + 2;

  std::uint32_t left_, top_;
  std::array<std::uint64_t, std::size_t{kColumns} * kRows> bodies_;  // row by row
};

}  // namespace gltfx::render
