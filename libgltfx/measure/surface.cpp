// SPDX-License-Identifier: Apache-2.0
#include "measure/surface.hpp"

#include <cmath>
#include <numbers>

#include "base/disjoint_sets.hpp"

namespace gltfx::measure {
namespace {

using model::Triangle;

Vec3d at(const std::vector<Float3>& positions, std::uint32_t vertex) {
  return to_vec(positions[vertex]);
}

// The normal of a triangle, twice as long as the area is large; 0 if it is degenerate.
Vec3d area_vector(const std::vector<Float3>& positions, const Triangle& triangle) {
  constexpr double kLeastHeight = 1e-12;  // of the longest side
  const Vec3d a = at(positions, triangle[0]);
  const Vec3d ab = at(positions, triangle[1]) - a;
  const Vec3d ac = at(positions, triangle[2]) - a;
  const Vec3d bc = ac - ab;
  const Vec3d normal = cross(ab, ac);
  const double longest = std::max({dot(ab, ab), dot(ac, ac), dot(bc, bc)});
  return length(normal) < kLeastHeight * longest ? Vec3d() : normal;
}

/// Counts vertices whose triangles make up several fans.
class Fans {
 public:
  explicit Fans(const Surface& surface)
      : surface_(surface),
        corners_(surface.triangles.size() * 3),
        fans_(surface.positions.size(), 0) {
    for (const Triangle& triangle : surface.triangles) {
      for (const std::uint32_t vertex : triangle) ++fans_[vertex];
    }
  }

  // The triangles of an edge are one fan at both of its ends.
  void join(const Edge& edge) {
    for (std::size_t i = 1; i < edge.size(); ++i) {
      const Corner a = edge.begin_of(0), b = edge.begin_of(i);
      const bool along = vertex_of(a) == vertex_of(b);
      join(a, along ? b : next_corner(b));
      join(next_corner(a), along ? next_corner(b) : b);
    }
  }
  std::uint64_t vertices_with_several() const {
    return static_cast<std::uint64_t>(
        std::count_if(fans_.begin(), fans_.end(), [](std::uint32_t fans) { return fans > 1; }));
  }

 private:
  std::uint32_t vertex_of(Corner corner) const {
    return surface_.triangles[corner / 3][corner % 3];
  }
  void join(Corner a, Corner b) {
    if (corners_.join(a, b)) --fans_[vertex_of(a)];
  }

  const Surface& surface_;
  DisjointSets corners_;
  std::vector<std::uint32_t> fans_;  // by vertex
};

}  // namespace

Surface make_surface(std::vector<Float3> positions, std::vector<Triangle> triangles) {
  Surface surface;
  surface.normals.reserve(triangles.size());
  std::size_t kept = 0;
  for (const Triangle& triangle : triangles) {
    const auto& [a, b, c] = triangle;
    if (a == b || b == c || c == a) continue;
    const Vec3d normal = area_vector(positions, triangle);
    const double size = length(normal);
    if (!(size > 0)) continue;
    surface.area += size / 2;
    surface.normals.push_back(normal / size);
    triangles[kept++] = triangle;
  }
  surface.degenerate = triangles.size() - kept;
  triangles.resize(kept);
  surface.positions = std::move(positions);
  surface.triangles = std::move(triangles);
  return surface;
}

EdgeCounts count_edges(const Surface& surface, double hard_angle, bool vertices) {
  constexpr double kAngleTolerance = 0.01;  // degrees
  constexpr double kRounding = 1e-12;
  const double angle =
      std::clamp(hard_angle - kAngleTolerance, 0.0, 180.0) * std::numbers::pi / 180;
  const double greatest_cosine = std::cos(angle) + kRounding;
  EdgeCounts counts;
  std::vector<Fans> fans;
  if (vertices) fans.emplace_back(surface);
  for_each_edge(surface, [&](const Edge& edge) {
    if (vertices) fans.front().join(edge);
    if (edge.size() == 1) ++counts.open;
    if (edge.size() > 2) ++counts.non_manifold;
    if (edge.size() != 2) return;
    const std::size_t one = edge.triangle(0), other = edge.triangle(1);
    const Corner a = edge.begin_of(0), b = edge.begin_of(1);
    if (surface.triangles[one][a % 3] == surface.triangles[other][b % 3]) ++counts.flipped;
    if (dot(surface.normals[one], surface.normals[other]) <= greatest_cosine) ++counts.hard;
  });
  if (vertices) counts.non_manifold_vertices = fans.front().vertices_with_several();
  return counts;
}

std::uint64_t count_shells(const Surface& surface) {
  DisjointSets shells(surface.positions.size());
  std::vector<bool> used(surface.positions.size());
  std::uint64_t count = 0;
  for (const Triangle& triangle : surface.triangles) {
    for (const std::uint32_t vertex : triangle) {
      if (!used[vertex]) ++count;
      used[vertex] = true;
    }
    for (std::size_t k = 1; k < 3; ++k) {
      if (shells.join(triangle[0], triangle[k])) --count;
    }
  }
  return count;
}

std::uint64_t count_duplicates(const Surface& surface) {
  std::vector<std::uint32_t> sizes(surface.positions.size());
  for (const auto& [a, b, c] : surface.triangles) ++sizes[std::min({a, b, c})];
  VertexLists lists(std::move(sizes));
  for (Triangle triangle : surface.triangles) {
    std::sort(triangle.begin(), triangle.end());
    lists.put(triangle[0], std::uint64_t{triangle[1]} << 32U | triangle[2]);
  }
  std::uint64_t count = 0;
  lists.visit_sorted([&](std::uint32_t, std::span<const std::uint64_t> others) {
    for (std::size_t i = 1; i < others.size(); ++i) count += others[i] == others[i - 1] ? 1 : 0;
  });
  return count;
}

double enclosed_volume(const Surface& surface) {
  if (surface.positions.empty()) return 0;
  const Vec3d origin = at(surface.positions, 0);  // near the surface: less is lost to rounding
  double sum = 0;
  for (const auto& [a, b, c] : surface.triangles) {
    const Vec3d to_a = at(surface.positions, a) - origin;
    const Vec3d to_b = at(surface.positions, b) - origin;
    const Vec3d to_c = at(surface.positions, c) - origin;
    sum += dot(to_a, cross(to_b, to_c));
  }
  return std::abs(sum) / 6;
}

}  // namespace gltfx::measure
