// SPDX-License-Identifier: Apache-2.0
#include "base/equal_records.hpp"

#include <algorithm>
#include <array>
#include <bit>

#include "base/secret_hash.hpp"

namespace gltfx {
std::vector<std::uint32_t> first_equal_records(std::string_view bytes, std::size_t size) {
  const KeyedHash& hash = secret_hash();
  constexpr std::uint32_t kNone = UINT32_MAX;
  constexpr std::size_t kBlock = 64;
  const auto record = [&](std::size_t i) { return bytes.substr(i * size, size); };
  const std::size_t count = bytes.size() / size;
  std::vector<std::uint32_t> first(count);
  std::vector<std::uint32_t> table(std::bit_ceil(count * 2 + 2), kNone);  // with open addresses
  std::array<std::size_t, kBlock> slots{};
  for (std::size_t begin = 0; begin < count; begin += kBlock) {
    const std::size_t end = std::min(begin + kBlock, count);
    for (std::size_t i = begin; i < end; ++i) {
      slots[i - begin] = static_cast<std::size_t>(hash.of(record(i)).low) & (table.size() - 1);
      __builtin_prefetch(&table[slots[i - begin]]);  // the table is larger than the caches
    }
    for (std::size_t i = begin; i < end; ++i) {
      std::size_t slot = slots[i - begin];
      while (table[slot] != kNone && record(table[slot]) != record(i)) {
        slot = (slot + 1) & (table.size() - 1);
      }
      if (table[slot] == kNone) table[slot] = static_cast<std::uint32_t>(i);
      first[i] = table[slot];
    }
  }
  return first;
}

}  // namespace gltfx
