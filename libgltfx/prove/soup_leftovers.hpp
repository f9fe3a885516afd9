// SPDX-License-Identifier: Apache-2.0
/// Elements of two soups that are not equal, by their hashes.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "base/hash.hpp"

namespace gltfx::prove {

/// Sorts elements by their hashes, then by their places.
void sort_by_hash(std::vector<std::uint32_t>& elements, const std::vector<Hash128>& hashes);

/// Elements of each list that the other one does not have, in order. Those of zeros are left out.
std::pair<std::vector<std::uint32_t>, std::vector<std::uint32_t>> find_leftovers(
    const std::vector<Hash128>& here, const std::vector<Hash128>& there);

}  // namespace gltfx::prove
