// SPDX-License-Identifier: Apache-2.0
/// Contact sheets: many pictures in one.
#pragma once

#include <gltfx/bake.hpp>

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "preview/picture.hpp"

namespace gltfx::preview {

/// A grid of cells, filled row by row, as many columns as rows or a few more.
class ContactSheet {
 public:
  /// `count`: number of pictures, at least 1. `size`: of each picture; cells have its shape.
  ContactSheet(std::size_t count, const BakeSize& size);

  /// Adds the next picture, scaled to fit into a cell, with its name below if there is room. A cell
  /// without pixels shows the text `instead`.
  void add(const BakedPixels& pixels, std::string_view name, std::string_view instead);
  Picture take();

 private:
  void place(const BakedPixels& pixels, std::uint32_t left, std::uint32_t top);
  void write(std::string_view words, std::uint32_t left, std::uint32_t top);

  std::size_t columns_, next_ = 0;
  std::uint32_t width_, height_;  ///< of a cell
  std::uint32_t label_;           ///< height of the line below
  Picture picture_;
};

/// A label for each path: its name without ending, with as many of its folders as distinguish it
/// from the others.
std::vector<std::string> sheet_labels(const std::vector<std::string>& paths);

}  // namespace gltfx::preview
