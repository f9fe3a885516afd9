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

Leftovers find_leftovers(const std::vector<Hash128>& here, const std::vector<Hash128>& there) {
  const std::vector<std::uint32_t> ours = seen_elements(here);
  const std::vector<std::uint32_t> theirs = seen_elements(there);
  Leftovers left;
  std::size_t i = 0, k = 0;
  while (i < ours.size() || k < theirs.size()) {
    const bool only_ours =
        k == theirs.size() || (i < ours.size() && hash_less(here[ours[i]], there[theirs[k]]));
    const bool only_theirs =
        !only_ours && (i == ours.size() || hash_less(there[theirs[k]], here[ours[i]]));
    if (only_ours) {
      left.ours.push_back(ours[i++]);
    } else if (only_theirs) {
      left.theirs.push_back(theirs[k++]);
    } else {
      ++i;
      ++k;
    }
  }
  std::sort(left.ours.begin(), left.ours.end());
  std::sort(left.theirs.begin(), left.theirs.end());
  return left;
}

}  // namespace gltfx::prove
