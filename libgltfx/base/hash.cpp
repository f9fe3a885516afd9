// SPDX-License-Identifier: Apache-2.0
#include "base/hash.hpp"

#include <algorithm>

// Header only: it is fast if compiled with the options of the caller.
#define XXH_INLINE_ALL
#include <xxhash.h>

namespace gltfx {

Hash128 hash_bytes(std::string_view bytes) {
  const XXH128_hash_t hash = XXH3_128bits(bytes.data(), bytes.size());
  return {hash.low64, hash.high64};
}

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

Hash128 KeyedHash::of(std::string_view bytes) const {
  const XXH128_hash_t hash =
      XXH3_128bits_withSecret(bytes.data(), bytes.size(), secret_.data(), secret_.size());
  return {hash.low64, hash.high64};
}

void HashParts::add(std::string_view text) {
  add(std::uint64_t{text.size()});
  bytes_ += text;
}

void HashParts::add(std::uint64_t number) {
  for (int byte = 0; byte < 8; ++byte) bytes_ += static_cast<char>(number >> (8 * byte) & 0xFFU);
}

void HashParts::add(const Hash128& hash) {
  add(hash.low);
  add(hash.high);
}

}  // namespace gltfx
