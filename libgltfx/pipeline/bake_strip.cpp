// SPDX-License-Identifier: Apache-2.0
#include "pipeline/bake_strip.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace gltfx {
namespace {

// `from` has `frames` frames one below the other.
template <class Number>
std::vector<Number> in_grid(const std::vector<Number>& from, const preview::Picture& column,
                            std::uint32_t frames) {
  const FrameGrid grid = grid_of(frames);
  const std::size_t row = std::size_t{column.width} * column.channels;  // of one frame
  const std::size_t height = column.height / frames;
  std::vector<Number> to(row * grid.columns * height * grid.rows);
  for (std::size_t i = 0; i < frames; ++i) {
    const std::size_t top = i / grid.columns * height;
    const std::size_t left = i % grid.columns * row;
    for (std::size_t y = 0; y < height; ++y) {
      const auto begin = from.begin() + static_cast<std::ptrdiff_t>((i * height + y) * row);
      std::copy_n(begin, row,
                  to.begin() + static_cast<std::ptrdiff_t>((top + y) * row * grid.columns + left));
    }
  }
  return to;
}

}  // namespace

void FrameStrip::add(preview::Picture frame) {
  if (frames_++ == 0) {
    column_ = std::move(frame);
    return;
  }
  column_.height += frame.height;
  column_.bytes.insert(column_.bytes.end(), frame.bytes.begin(), frame.bytes.end());
  column_.floats.insert(column_.floats.end(), frame.floats.begin(), frame.floats.end());
}

preview::Picture FrameStrip::grid() const {
  const FrameGrid grid = grid_of(frames_);
  preview::Picture picture;
  picture.width = column_.width * grid.columns;
  picture.height = column_.height / frames_ * grid.rows;
  picture.channels = column_.channels;
  if (!column_.bytes.empty()) picture.bytes = in_grid(column_.bytes, column_, frames_);
  if (!column_.floats.empty()) picture.floats = in_grid(column_.floats, column_, frames_);
  return picture;
}

FrameGrid grid_of(std::uint32_t frames) {
  const auto columns =
      static_cast<std::uint32_t>(std::ceil(std::sqrt(static_cast<double>(frames))));
  return {columns, (frames + columns - 1) / columns};
}

}  // namespace gltfx
