// SPDX-License-Identifier: Apache-2.0
/// Frames of equal size on their way to one file.
#pragma once

#include <cstdint>

#include "preview/picture.hpp"

namespace gltfx {

class FrameStrip {
 public:
  void add(preview::Picture frame);

  std::uint32_t frames() const { return frames_; }
  /// One below the other.
  const preview::Picture& column() const { return column_; }
  /// In a grid, in rows from the top: as many columns as the root of their number, rounded up.
  /// Cells that are left are 0. Precondition: there is a frame.
  preview::Picture grid() const;

 private:
  preview::Picture column_;
  std::uint32_t frames_ = 0;
};

/// Columns and rows of the grid.
struct FrameGrid {
  std::uint32_t columns = 1, rows = 1;
};
FrameGrid grid_of(std::uint32_t frames);

}  // namespace gltfx
