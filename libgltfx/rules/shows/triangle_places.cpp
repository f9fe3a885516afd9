// SPDX-License-Identifier: Apache-2.0
#include "rules/shows/triangle_places.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace gltfx::validate {

std::int64_t place_cell(double value, double cell) {
  // Numbers that are not round.
  constexpr double kOffset = 0.381966, kScale = 1.2345;
  const double at = std::floor(value / (cell * kScale) + kOffset);
  return std::abs(at) < 1e18 ? static_cast<std::int64_t>(at) : 0;
}

std::uint64_t joined_place(std::uint64_t hash, std::int64_t number) {
  hash = (hash ^ static_cast<std::uint64_t>(number)) * 0x9E37'79B9'7F4A'7C15U;
  return hash ^ (hash >> 29U);
}

std::vector<std::uint64_t> places_of_triangles(const TriangleReader& triangles,
                                               const model::Affine& world,
                                               const model::Vector3& origin, double cell) {
  std::vector<std::uint64_t> found;
  const bool mirrored = world.determinant() < 0;
  found.reserve(static_cast<std::size_t>(triangles.count()));
  for (std::uint64_t i = 0; i < triangles.count(); ++i) {
    const auto corners = triangles.corners(i);
    if (!corners) continue;
    std::array<std::uint64_t, 3> hashes{};
    for (std::size_t k = 0; k < 3; ++k) {
      const Float3 at = triangles.position((*corners)[k]);
      const model::Vector3 place = world.point(
          {static_cast<double>(at[0]), static_cast<double>(at[1]), static_cast<double>(at[2])});
      for (std::size_t axis = 0; axis < 3; ++axis) {
        hashes[k] = joined_place(hashes[k] + 1, place_cell(place[axis] - origin[axis], cell));
      }
    }
    if (hashes[0] == hashes[1] || hashes[1] == hashes[2] || hashes[2] == hashes[0]) continue;
    if (mirrored) std::swap(hashes[1], hashes[2]);
    std::rotate(hashes.begin(), std::min_element(hashes.begin(), hashes.end()), hashes.end());
    std::uint64_t hash = 0;
    for (const std::uint64_t each : hashes) {
      hash = joined_place(hash, static_cast<std::int64_t>(each));
    }
    found.push_back(hash);
  }
  std::sort(found.begin(), found.end());
  return found;
}

}  // namespace gltfx::validate
