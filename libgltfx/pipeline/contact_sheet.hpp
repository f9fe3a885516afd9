// SPDX-License-Identifier: Apache-2.0
/// Many pictures on one.
#pragma once

#include <gltfx/bake.hpp>

#include <cstddef>

#include "bake/develop.hpp"

namespace gltfx {

/// A grid of cells, filled row by row, as many columns as rows or a few more.
class ContactSheet {
 public:
  /// `count`: pictures to come, at least 1.
  explicit ContactSheet(std::size_t count);

  /// The next one, made to fit into a cell. One without pixels leaves its cell empty.
  void add(const BakedPixels& pixels);
  bake::Picture take();

 private:
  std::size_t columns_, next_ = 0;
  std::uint32_t cell_;
  bake::Picture picture_;
};

}  // namespace gltfx
