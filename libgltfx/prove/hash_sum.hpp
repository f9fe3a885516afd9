// SPDX-License-Identifier: Apache-2.0
/// Hashes of contents that come from untrusted assets, and sums of them for sets without order.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <tuple>

#include "base/secret_hash.hpp"

namespace gltfx::prove {

/// Order for sorting equal hashes next to each other. It differs from run to run: results must not
/// depend on it.
inline bool hash_less(const Hash128& a, const Hash128& b) {
  return std::tie(a.high, a.low) < std::tie(b.high, b.low);
}

inline Hash128 hash_content(std::string_view bytes) { return secret_hash().of(bytes); }

/// The hash of a list of values without padding.
template <class... T>
Hash128 hash_of_all(const T&... values) {
  char bytes[(sizeof(T) + ...)];
  char* to = bytes;
  ((std::copy_n(reinterpret_cast<const char*>(&values), sizeof(T), to), to += sizeof(T)), ...);
  return hash_content({bytes, sizeof(bytes)});
}

/// Adds an element of a set.
inline void add_to_sum(Hash128& sum, const Hash128& hash) {
  sum.low += hash.low;
  sum.high += hash.high + (sum.low < hash.low ? 1U : 0U);
}

struct HashHasher {
  std::size_t operator()(const Hash128& hash) const { return static_cast<std::size_t>(hash.low); }
};

}  // namespace gltfx::prove
