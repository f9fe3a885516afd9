// SPDX-License-Identifier: Apache-2.0
// Hashes of the elements of a soup.
#include <algorithm>
#include <array>
#include <utility>

#include "prove/hash_sum.hpp"
#include "prove/soup.hpp"

namespace gltfx::prove {
namespace {

bool turn_is_least(const std::array<Hash128, 3>& a, const std::array<Hash128, 3>& b,
                   std::size_t arity) {
  return std::lexicographical_compare(a.begin(), a.begin() + static_cast<std::ptrdiff_t>(arity),
                                      b.begin(), b.begin() + static_cast<std::ptrdiff_t>(arity),
                                      hash_less);
}

std::vector<Hash128> hash_vertices(const Soup& soup, const SoupStream* without) {
  std::vector<Hash128> vertices(soup.vertices());
  std::vector<double> row(soup.width);
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    std::copy_n(soup.row(static_cast<std::uint32_t>(i)), soup.width, row.begin());
    for (double& each : row) {
      if (each == 0) each = 0;
    }
    if (without != nullptr) std::fill_n(row.begin() + without->offset, without->width, 0);
    vertices[i] =
        hash_content({reinterpret_cast<const char*>(row.data()), row.size() * sizeof(double)});
  }
  return vertices;
}

// `all`: also those that show nothing.
template <class Use>
void each_element_hash(const Soup& soup, const std::vector<Hash128>& vertices, bool all,
                       bool reversed, const Use& use) {
  const std::size_t arity = soup.arity;
  for (std::size_t e = 0; e < soup.elements(); ++e) {
    std::array<Hash128, 3> corners{};
    for (std::size_t k = 0; k < arity; ++k) corners[k] = vertices[soup.corners[e * arity + k]];
    const bool repeats = (arity > 1 && corners[0] == corners[1]) ||
                         (arity > 2 && (corners[1] == corners[2] || corners[0] == corners[2]));
    if (repeats && !all) continue;
    if (reversed) std::swap(corners[0], corners[arity - 1]);
    std::array<Hash128, 3> least = corners;
    for (std::size_t turn = 1; turn < arity; ++turn) {
      std::rotate(corners.begin(), corners.begin() + 1,
                  corners.begin() + static_cast<std::ptrdiff_t>(arity));
      if (turn_is_least(corners, least, arity)) least = corners;
    }
    use(e, hash_of_all(arity, least[0], least[1], least[2]));
  }
}

}  // namespace

std::vector<Hash128> hash_elements(const Soup& soup, const SoupStream* without, bool reversed) {
  const std::vector<Hash128> vertices = hash_vertices(soup, without);
  std::vector<Hash128> hashes(soup.elements());
  each_element_hash(soup, vertices, without != nullptr, reversed,
                    [&](std::size_t element, const Hash128& hash) { hashes[element] = hash; });
  return hashes;
}

Hash128 hash_order(const Soup& soup, Hash128 before) {
  for (const Hash128& each : hash_elements(soup)) {
    if (each != Hash128{}) before = hash_of_all(before, each);
  }
  return before;
}

Hash128 hash_soup(const Soup& soup) {
  Hash128 layout = hash_of_all(std::uint64_t{soup.readable});
  for (const SoupStream& stream : soup.streams) {
    layout = hash_of_all(layout, hash_content(stream.name), stream.width);
  }
  Hash128 sum;
  std::vector<Hash128> vertices = hash_vertices(soup, nullptr);
  each_element_hash(soup, vertices, false, false,
                    [&](std::size_t, const Hash128& hash) { add_to_sum(sum, hash); });
  if (sum != Hash128{}) return hash_of_all(layout, sum);
  std::sort(vertices.begin(), vertices.end(), hash_less);
  vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
  for (const Hash128& each : vertices) add_to_sum(sum, each);
  return hash_of_all(layout, std::uint64_t{soup.arity}, sum);
}

}  // namespace gltfx::prove
