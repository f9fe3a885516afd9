// SPDX-License-Identifier: Apache-2.0
#include "base/hash.hpp"

// Its speed comes from being compiled with the options of the caller; nothing is left to link.
#define XXH_INLINE_ALL
#include <xxhash.h>

namespace gltfx {

Hash128 hash_bytes(std::string_view bytes) {
  const XXH128_hash_t hash = XXH3_128bits(bytes.data(), bytes.size());
  return {hash.low64, hash.high64};
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
