// SPDX-License-Identifier: Apache-2.0
/// Sorting by unsigned keys in linear time, whatever the keys are.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/bit_cast.hpp"

namespace gltfx::measure {

/// A number and what it belongs to.
template <class Key>
struct Keyed {
  Key key = 0;
  std::uint32_t item = 0;
};

/// Sorts by key; items with one key keep their order.
template <class Key>
void radix_sort(std::vector<Keyed<Key>>& items) {
  constexpr unsigned kBits = 11;
  constexpr std::size_t kDigits = std::size_t{1} << kBits;
  std::vector<Keyed<Key>> sorted(items.size());
  for (unsigned shift = 0; shift < 8 * sizeof(Key); shift += kBits) {
    const auto digit = [shift](const Keyed<Key>& item) {
      return static_cast<std::size_t>(item.key >> shift) & (kDigits - 1);
    };
    std::array<std::size_t, kDigits> begin{};
    for (const auto& item : items) ++begin[digit(item)];
    if (!items.empty() && begin[digit(items.front())] == items.size()) continue;
    std::size_t sum = 0;
    for (std::size_t& count : begin) {
      const std::size_t next = sum + count;
      count = sum;
      sum = next;
    }
    for (const auto& item : items) sorted[begin[digit(item)]++] = item;
    items.swap(sorted);
  }
}

/// Bits that sort as the numbers do; 0 and -0 have the same.
inline std::uint32_t sortable_bits(float number) {
  const auto bits = bit_cast<std::uint32_t>(number == 0 ? 0.0F : number);
  return (bits >> 31U) != 0 ? ~bits : bits | 0x80000000U;
}

}  // namespace gltfx::measure
