// SPDX-License-Identifier: Apache-2.0
#include "prove/soup_leftovers.hpp"

#include <algorithm>

#include "prove/hash_sum.hpp"

namespace gltfx::prove {
namespace {

std::vector<std::uint32_t> seen_elements(const std::vector<Hash128>& hashes) {
  std::vector<std::uint32_t> elements;
  elements.reserve(hashes.size());
  for (std::uint32_t i = 0; i < hashes.size(); ++i) {
    if (hashes[i] != Hash128{}) elements.push_back(i);
  }
  sort_by_hash(elements, hashes);
  return elements;
}

}  // namespace

void sort_by_hash(std::vector<std::uint32_t>& elements, const std::vector<Hash128>& hashes) {
  std::sort(elements.begin(), elements.end(), [&](std::uint32_t a, std::uint32_t b) {
    return hashes[a] == hashes[b] ? a < b : hash_less(hashes[a], hashes[b]);
  });
}

std::pair<std::vector<std::uint32_t>, std::vector<std::uint32_t>> find_leftovers(
    const std::vector<Hash128>& here, const std::vector<Hash128>& there) {
  const std::vector<std::uint32_t> ours = seen_elements(here);
  const std::vector<std::uint32_t> theirs = seen_elements(there);
  std::vector<std::uint32_t> left, their_left;
  std::size_t i = 0, k = 0;
  while (i < ours.size() || k < theirs.size()) {
    const bool only_ours =
        k == theirs.size() || (i < ours.size() && hash_less(here[ours[i]], there[theirs[k]]));
    const bool only_theirs =
        !only_ours && (i == ours.size() || hash_less(there[theirs[k]], here[ours[i]]));
    if (only_ours) {
      left.push_back(ours[i++]);
    } else if (only_theirs) {
      their_left.push_back(theirs[k++]);
    } else {
      ++i;
      ++k;
    }
  }
  std::sort(left.begin(), left.end());
  std::sort(their_left.begin(), their_left.end());
  return {std::move(left), std::move(their_left)};
}

}  // namespace gltfx::prove
