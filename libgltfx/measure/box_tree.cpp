// SPDX-License-Identifier: Apache-2.0
#include "measure/box_tree.hpp"

#include "measure/radix_sort.hpp"

namespace gltfx::measure {
namespace {

constexpr unsigned kDropped = 10;   // bits of a float that hardly change the order
constexpr unsigned kRankBits = 11;  // so that both ranks take two passes of radix_sort()

// The position of each item among all, sorted along one axis, in kRankBits.
std::vector<std::uint32_t> ranks_along(std::span<const UvBox> boxes, bool vertical) {
  std::vector<Keyed<std::uint32_t>> sorted(boxes.size());
  for (std::uint32_t i = 0; i < sorted.size(); ++i) {
    const UvBox& box = boxes[i];
    const float middle =
        vertical ? box.least_v / 2 + box.most_v / 2 : box.least_u / 2 + box.most_u / 2;
    sorted[i] = {sortable_bits(middle) >> kDropped, i};
  }
  radix_sort(sorted);
  std::vector<std::uint32_t> ranks(boxes.size());
  for (std::size_t at = 0; at < sorted.size(); ++at) {
    ranks[sorted[at].item] = static_cast<std::uint32_t>((at << kRankBits) / sorted.size());
  }
  return ranks;
}

// 16 bits with a 0 before each.
std::uint32_t spread(std::uint32_t bits) {
  bits = (bits | bits << 8U) & 0x00FF00FFU;
  bits = (bits | bits << 4U) & 0x0F0F0F0FU;
  bits = (bits | bits << 2U) & 0x33333333U;
  return (bits | bits << 1U) & 0x55555555U;
}

}  // namespace

// In the order of a space-filling curve through ranks (G. M. Morton, 1966).
BoxTree::BoxTree(std::span<const UvBox> boxes) : order_(boxes.size()) {
  const auto columns = ranks_along(boxes, false);
  const auto rows = ranks_along(boxes, true);
  std::vector<Keyed<std::uint32_t>> sorted(boxes.size());
  for (std::uint32_t i = 0; i < sorted.size(); ++i) {
    sorted[i] = {spread(columns[i]) | spread(rows[i]) << 1U, i};
  }
  radix_sort(sorted);
  for (std::size_t i = 0; i < sorted.size(); ++i) order_[i] = sorted[i].item;
  std::vector<UvBox> below(boxes.size());
  for (std::size_t i = 0; i < below.size(); ++i) below[i] = boxes[order_[i]];
  while (below.size() > 1 || (levels_.empty() && !below.empty())) {
    std::vector<UvBox> level((below.size() + kFanout - 1) / kFanout);
    for (std::size_t i = 0; i < below.size(); ++i) level[i / kFanout].include(below[i]);
    below = level;
    levels_.push_back(std::move(level));
  }
}

}  // namespace gltfx::measure
