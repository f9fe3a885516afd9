// SPDX-License-Identifier: Apache-2.0
#include "upgrade/content_hash.hpp"

#include <algorithm>
#include <cstddef>

namespace gltfx::upgrade {

// FNV-1a on words of eight bytes, the last one filled up with zeros, with the halves mixed after
// each; the length counts, too.
std::uint64_t content_hash(std::string_view bytes) {
  constexpr std::uint64_t kPrime = 0x100000001B3;
  std::uint64_t hash = 0xCBF29CE484222325 ^ bytes.size();
  while (!bytes.empty()) {
    const std::size_t size = std::min<std::size_t>(8, bytes.size());
    std::uint64_t word = 0;
    for (std::size_t i = 0; i < size; ++i) {
      word |= std::uint64_t{static_cast<unsigned char>(bytes[i])} << (8 * i);
    }
    hash = (hash ^ word) * kPrime;
    hash ^= hash >> 32U;
    bytes.remove_prefix(size);
  }
  return hash * kPrime ^ hash >> 29U;
}

}  // namespace gltfx::upgrade
