// SPDX-License-Identifier: Apache-2.0
/// A tree of rectangles: finds those near a place.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "measure/uv_plane.hpp"

namespace gltfx::measure {

/// Items in leaves of neighbours; eight nodes are below each other one. Takes time linear in the
/// items, whatever their sizes and places: a far item does not change the order of the others.
class BoxTree {
 public:
  static constexpr std::size_t kFanout = 8;

  /// Preconditions: all boxes are finite, and there are less than 2^32.
  explicit BoxTree(std::span<const UvBox> boxes);

  /// The items in the order of the leaves: leaf i has those from i * kFanout on.
  const std::vector<std::uint32_t>& order() const { return order_; }
  std::size_t leaves() const { return levels_.empty() ? 0 : levels_.front().size(); }
  /// The number of levels; level 0 are the leaves, the last one has one node.
  std::size_t height() const { return levels_.size(); }
  const std::vector<UvBox>& level(std::size_t level) const { return levels_[level]; }

  /// Calls `enters(level, node)` from the root on; where it is true, for what is below, in the
  /// order of the items. At leaves `enters` is the visit, and its result is ignored.
  template <class Enters>
  void walk(const Enters& enters) const {
    struct Step {
      std::uint32_t level, node;
    };
    if (levels_.empty()) return;
    std::array<Step, kMostLevels * kFanout> open;
    std::size_t count = 0;
    open[count++] = {static_cast<std::uint32_t>(height() - 1), 0};
    while (count > 0) {
      const auto [level, node] = open[--count];
      if (!enters(level, node) || level == 0) continue;
      const std::size_t first = std::size_t{node} * kFanout;
      const std::size_t last = std::min(first + kFanout, levels_[level - 1].size());
      for (std::size_t child = last; child > first; --child) {
        open[count++] = {level - 1, static_cast<std::uint32_t>(child - 1)};
      }
    }
  }

 private:
  static constexpr std::size_t kMostLevels = 11;  // of 2^32 items

  std::vector<std::uint32_t> order_;
  std::vector<std::vector<UvBox>> levels_;
};

}  // namespace gltfx::measure
