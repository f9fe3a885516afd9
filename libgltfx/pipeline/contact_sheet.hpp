// SPDX-License-Identifier: Apache-2.0
/// Many pictures on one.
#pragma once

#include <gltfx/bake.hpp>

#include <cstddef>
#include <cstdint>
#include <string_view>

#include "bake/picture.hpp"

namespace gltfx {

/// A grid of cells, filled row by row, as many columns as rows or a few more.
class ContactSheet {
 public:
  /// `count`: pictures to come, at least 1. `size`: theirs; cells are of its shape.
  ContactSheet(std::size_t count, const BakeSize& size);

  /// The next one, made to fit into a cell, with its name below where there is room for words. One
  /// without pixels leaves its cell empty.
  void add(const BakedPixels& pixels, std::string_view name);
  bake::Picture take();

 private:
  void place(const BakedPixels& pixels, std::uint32_t left, std::uint32_t top);

  std::size_t columns_, next_ = 0;
  std::uint32_t width_, height_;  ///< of a cell
  std::uint32_t label_;           ///< height of the line below
  bake::Picture picture_;
};

}  // namespace gltfx
