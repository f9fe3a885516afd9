// SPDX-License-Identifier: Apache-2.0
/// A surface of triangles over distinct positions: its area, edges, parts and volume. Nothing here
/// reads an asset.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "base/packed.hpp"
#include "model/geometry.hpp"

namespace gltfx::measure {

/// Triangles that have an area.
struct Surface {
  std::vector<Float3> positions;  ///< distinct; weld() makes them
  std::vector<model::Triangle> triangles;
  std::vector<Vec3d> normals;    ///< of the triangles, of length 1, by the order of their vertices
  double area = 0;               ///< of all triangles
  std::uint64_t degenerate = 0;  ///< triangles that make_surface() has left out
};

/// Leaves out degenerate triangles: with a vertex twice, or a height below 1e-12 of the longest
/// side. Precondition: positions are distinct and finite, and each index is that of one.
Surface make_surface(std::vector<Float3> positions, std::vector<model::Triangle> triangles);

/// Lists of numbers by the vertex that they belong to, each sorted. Precondition: put() is
/// called as often for each vertex as `sizes` says.
class VertexLists {
 public:
  explicit VertexLists(std::vector<std::uint32_t> sizes) : ends_(std::move(sizes)) {
    std::uint32_t begin = 0;
    for (std::uint32_t& each : ends_) begin += std::exchange(each, begin);
    numbers_.resize(begin);
  }

  void put(std::uint32_t vertex, std::uint64_t number) { numbers_[ends_[vertex]++] = number; }
  /// Calls `visit(vertex, numbers)` for each vertex that has some. Call it once, at the end.
  template <typename Visit>
  void visit_sorted(Visit visit) {
    std::uint32_t begin = 0;
    for (std::uint32_t vertex = 0; vertex < ends_.size(); ++vertex) {
      const std::span<std::uint64_t> list(numbers_.data() + begin, ends_[vertex] - begin);
      std::sort(list.begin(), list.end());
      if (!list.empty()) visit(vertex, std::span<const std::uint64_t>(list));
      begin = ends_[vertex];
    }
  }

 private:
  std::vector<std::uint32_t> ends_;  // of the lists; while they are filled, of what they have
  std::vector<std::uint64_t> numbers_;
};

/// A corner of a triangle: three times the index of the triangle, and 0, 1 or 2.
using Corner = std::uint32_t;
constexpr Corner next_corner(Corner corner) { return corner % 3 == 2 ? corner - 2 : corner + 1; }

/// An edge of a surface and the triangles that have it.
class Edge {
 public:
  Edge(std::uint32_t low, std::span<const std::uint64_t> uses) : low_(low), uses_(uses) {}

  std::uint32_t low() const { return low_; }  ///< the vertex with the lesser index
  std::uint32_t high() const { return static_cast<std::uint32_t>(uses_.front() >> 32U); }
  /// How many triangles it has.
  std::size_t size() const { return uses_.size(); }
  /// The corner at which a triangle begins to run along the edge; it ends at the next one.
  Corner begin_of(std::size_t i) const { return static_cast<Corner>(uses_[i]); }
  std::size_t triangle(std::size_t i) const { return begin_of(i) / 3; }

 private:
  std::uint32_t low_;
  std::span<const std::uint64_t> uses_;
};

/// Calls `visit` with each edge, by the lower vertex, then by the higher one. n log n steps.
/// Precondition: fewer than 2^32 corners.
template <typename Visit>
void for_each_edge(const Surface& surface, Visit visit) {
  const auto& triangles = surface.triangles;
  std::vector<std::uint32_t> sizes(surface.positions.size());
  for (const auto& [a, b, c] : triangles) {
    ++sizes[std::min(a, b)];
    ++sizes[std::min(b, c)];
    ++sizes[std::min(c, a)];
  }
  VertexLists lists(std::move(sizes));
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      const auto [low, high] = std::minmax(triangles[i][k], triangles[i][(k + 1) % 3]);
      lists.put(low, std::uint64_t{high} << 32U | (3 * i + k));
    }
  }
  lists.visit_sorted([&](std::uint32_t low, std::span<const std::uint64_t> uses) {
    while (!uses.empty()) {
      const std::uint64_t beyond = ((uses.front() >> 32U) + 1) << 32U;
      const auto end =
          std::find_if(uses.begin(), uses.end(), [&](std::uint64_t use) { return use >= beyond; });
      const auto size = static_cast<std::size_t>(end - uses.begin());
      visit(Edge(low, uses.first(size)));
      uses = uses.subspan(size);
    }
  });
}

struct EdgeCounts {
  std::uint64_t open = 0;                   ///< with one triangle
  std::uint64_t non_manifold = 0;           ///< with three or more
  std::uint64_t flipped = 0;                ///< with two that run along it in the same direction
  std::uint64_t hard = 0;                   ///< with two whose normals enclose a large angle
  std::uint64_t non_manifold_vertices = 0;  ///< see count_edges()

  /// Whether the surface bounds a body.
  bool closed() const { return open == 0 && non_manifold == 0 && flipped == 0; }
};

/// `hard_angle`: degrees from which an edge is hard. `vertices`: count also vertices whose
/// triangles make up several fans that share no edge there.
EdgeCounts count_edges(const Surface& surface, double hard_angle, bool vertices);

/// Parts whose triangles share no vertex with other parts.
std::uint64_t count_shells(const Surface& surface);

/// Triangles with the same vertices as another one, in any order, beyond the first.
std::uint64_t count_duplicates(const Surface& surface);

/// The volume inside of a closed surface; that of shells which face inwards is taken away. Positive
/// also if all of it is inside out.
double enclosed_volume(const Surface& surface);

}  // namespace gltfx::measure
