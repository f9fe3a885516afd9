// SPDX-License-Identifier: Apache-2.0
/// Elements of two soups without an equal one, by their hashes (hash_elements()).
#pragma once

#include <cstdint>
#include <vector>

#include "base/hash.hpp"

namespace gltfx::prove {

/// By their hashes, then by their places.
void sort_by_hash(std::vector<std::uint32_t>& elements, const std::vector<Hash128>& hashes);

struct Leftovers {
  std::vector<std::uint32_t> ours, theirs;  ///< in order
};
/// Elements that show something and that the other soup does not have, or not as often. n log n.
Leftovers find_leftovers(const std::vector<Hash128>& here, const std::vector<Hash128>& there);

}  // namespace gltfx::prove
