// SPDX-License-Identifier: Apache-2.0
#include "rules/shows/facing.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/bit_cast.hpp"
#include "model/elements.hpp"

namespace gltfx::validate {
namespace {

std::uint64_t mixed(std::uint64_t value) {
  value = (value ^ (value >> 32U)) * 0x9E37'79B9'7F4A'7C15U;
  value = (value ^ (value >> 29U)) * 0xBF58'476D'1CE4'E5B9U;
  return value ^ (value >> 32U);
}

// Vertices at one place are the same.
std::uint64_t hash_of_place(const Float3& place) {
  std::uint64_t hash = 0;
  for (const float each : place) hash = mixed(hash ^ bit_cast<std::uint32_t>(each + 0.0F)) + 1;
  return hash;
}

std::uint64_t hash_of_edge(std::uint64_t from, std::uint64_t to) { return mixed(from + 3 * to); }

void add_edges(const std::array<std::uint32_t, 3>& corners,
               const std::vector<std::uint64_t>& places, Facing& facing) {
  for (std::size_t k = 0; k < 3; ++k) {
    const std::uint64_t a = places[corners[k]], b = places[corners[(k + 1) % 3]];
    facing.edges += hash_of_edge(a, b) - hash_of_edge(b, a);
  }
}

void add_triangle(const std::array<Float3, 3>& places, const Vec3d& origin, Facing& facing,
                  Vec3d& across) {
  const Vec3d a = to_vec(places[0]);
  across = cross(to_vec(places[1]) - a, to_vec(places[2]) - a);
  const double area = length(across);
  if (!(area > 0) || !std::isfinite(area)) {
    across = {};
    return;
  }
  facing.looked += 1;
  facing.area += area;
  facing.sum += across;
  facing.directions += across / area;
  const double volume = dot(a - origin, across);
  facing.volume += volume;
  facing.gross += std::abs(volume);
  facing.sides += volume > 0 ? 1 : -1;
}

void add_normals(const TriangleReader& triangles, const std::array<std::uint32_t, 3>& corners,
                 std::size_t count, const Vec3d& across, Facing& facing) {
  if (!triangles.has_normals()) return;
  Vec3d normal;
  for (std::size_t k = 0; k < count; ++k) normal += to_vec(triangles.normal(corners[k]));
  const double along = dot(normal, across);
  if (!(std::abs(along) > 0)) return;
  facing.judged += 1;
  if (along < 0) facing.against += 1;
}

// One of the triangles of each of so many equal parts of the list: any of them, since the list may
// repeat a pattern. Preconditions: no more parts than triangles, and fewer than 2^24.
std::uint64_t drawn_triangle(std::uint64_t count, std::uint64_t parts, std::uint64_t part) {
  const std::uint64_t begin = count * part / parts;
  const std::uint64_t length = count * (part + 1) / parts - begin;
  return begin + mixed(part + 1) % length;
}

}  // namespace

void Facing::add(const Facing& other, double weight) {
  looked += weight * other.looked;
  judged += weight * other.judged;
  against += weight * other.against;
  area += weight * other.area;
  volume += weight * other.volume;
  gross += weight * other.gross;
  sides += weight * other.sides;
  sum += weight * other.sum;
  directions += weight * other.directions;
  edges += other.edges;
}

bool Facing::turned() const {
  constexpr double kMostOf = 0.75;
  return judged > 0 && judged >= kMostOf * looked && against >= kMostOf * judged;
}

bool Facing::surely_outward(double share) const {
  return volume > share * gross && sides > share * looked;
}

bool Facing::surely_open(double share) const {
  return length(sum) > share * area && length(directions) > share * looked;
}

Facing sum_some(const TriangleReader& triangles, std::uint64_t most, std::size_t normals,
                const Vec3d& origin) {
  Facing facing;
  const std::uint64_t count = triangles.count();
  const std::uint64_t looked = std::min(count, most);
  for (std::uint64_t i = 0; i < looked; ++i) {
    const auto corners = triangles.corners(looked == count ? i : drawn_triangle(count, looked, i));
    if (!corners) continue;
    std::array<Float3, 3> places{};
    for (std::size_t k = 0; k < 3; ++k) places[k] = triangles.position((*corners)[k]);
    Vec3d across;
    add_triangle(places, origin, facing, across);
    add_normals(triangles, *corners, normals, across, facing);
  }
  return facing;
}

Facing sum_all(const TriangleReader& triangles, const Vec3d& origin) {
  Facing facing;
  model::Vectors<3> positions(static_cast<std::size_t>(triangles.vertex_count()));
  model::read_elements(triangles.positions(), positions);
  std::vector<std::uint64_t> hashes(positions.size());
  std::transform(positions.begin(), positions.end(), hashes.begin(), hash_of_place);
  for (std::uint64_t i = 0; i < triangles.count(); ++i) {
    const auto corners = triangles.corners(i);
    if (!corners) continue;
    const auto& [a, b, c] = *corners;
    Vec3d across;
    add_triangle({positions[a], positions[b], positions[c]}, origin, facing, across);
    add_edges(*corners, hashes, facing);
    add_normals(triangles, *corners, 3, across, facing);
  }
  return facing;
}

}  // namespace gltfx::validate
