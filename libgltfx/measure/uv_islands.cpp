// SPDX-License-Identifier: Apache-2.0
#include "measure/uv_islands.hpp"

#include <algorithm>
#include <utility>

#include "base/disjoint_sets.hpp"
#include "measure/radix_sort.hpp"

namespace gltfx::measure {
namespace {

// For each point the first one with the same coordinates.
std::vector<std::uint32_t> first_equal_points(const model::Vectors<2>& points) {
  std::vector<Keyed<std::uint64_t>> sorted(points.size());
  for (std::uint32_t i = 0; i < sorted.size(); ++i) {
    const auto& [u, v] = points[i];
    sorted[i] = {std::uint64_t{sortable_bits(u)} << 32U | sortable_bits(v), i};
  }
  radix_sort(sorted);
  std::vector<std::uint32_t> first(points.size());
  for (std::size_t i = 0; i < sorted.size(); ++i) {
    const bool again = i > 0 && sorted[i].key == sorted[i - 1].key;
    first[sorted[i].item] = again ? first[sorted[i - 1].item] : sorted[i].item;
  }
  return first;
}

// An edge of a triangle, listed at its lower point.
struct UvEdge {
  std::uint32_t to = 0;        // its other point
  std::uint32_t triangle = 0;  // times 2, and 1 more if the triangle is on the right
  bool operator<(const UvEdge& other) const {
    return std::pair(to, triangle) < std::pair(other.to, other.triangle);
  }
};

class IslandFinder {
 public:
  explicit IslandFinder(const UvSurface& surface)
      : surface_(surface),
        first_(first_equal_points(surface.points)),
        sets_(surface.triangles.size()) {}

  UvIslands run() {
    list_edges();
    for (std::uint32_t point = 0; point + 1 < begin_.size(); ++point) {
      const auto first = edges_.begin() + begin_[point];
      const auto last = edges_.begin() + begin_[point + 1];
      std::sort(first, last);
      for (auto at = first; at != last;) {
        const auto next =
            std::find_if(at, last, [&](const UvEdge& each) { return each.to != at->to; });
        take_edge(point, std::span(at, next));
        at = next;
      }
    }
    for (UvOutline& outline : islands_.outlines) outline.island = sets_.find(outline.island);
    for (std::uint32_t i = 0; i < surface_.triangles.size(); ++i) {
      if (sets_.find(i) == i) ++islands_.count;
    }
    return std::move(islands_);
  }

 private:
  template <class Use>
  void for_each_edge(const Use& use) const {
    for (std::uint32_t i = 0; i < surface_.triangles.size(); ++i) {
      const model::Triangle& triangle = surface_.triangles[i];
      for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t from = first_[triangle[k]];
        const std::uint32_t to = first_[triangle[(k + 1) % 3]];
        use(std::min(from, to), std::max(from, to), first_[triangle[(k + 2) % 3]], i);
      }
    }
  }

  // begin_[p + 2] counts, begin_[p + 1] is where to write, and at last begin_[p] where p begins.
  void list_edges() {
    begin_.assign(surface_.points.size() + 2, 0);
    for_each_edge([&](std::uint32_t from, std::uint32_t, std::uint32_t, std::uint32_t) {
      ++begin_[from + std::size_t{2}];
    });
    for (std::size_t i = 2; i < begin_.size(); ++i) begin_[i] += begin_[i - 1];
    edges_.resize(3 * surface_.triangles.size());
    for_each_edge([&](std::uint32_t from, std::uint32_t to, std::uint32_t third, std::uint32_t i) {
      const auto& points = surface_.points;
      const bool right = turn(points[from], points[to], points[third]) > 0;
      edges_[begin_[from + std::size_t{1}]++] = {to, 2 * i + (right ? 1U : 0U)};
    });
    begin_.pop_back();
  }

  // `edges`: those between the same two points.
  void take_edge(std::uint32_t from, std::span<const UvEdge> edges) {
    const UvEdge& first = edges.front();
    bool outline = true;
    for (const UvEdge& each : edges) {
      if (((each.triangle ^ first.triangle) & 1U) != 0) outline = false;
      sets_.join(each.triangle / 2, first.triangle / 2);
    }
    if (!outline) return;
    islands_.outlines.push_back(
        {surface_.points[from], surface_.points[first.to], first.triangle / 2});
  }

  const UvSurface& surface_;
  const std::vector<std::uint32_t> first_;  // by point
  DisjointSets sets_;
  std::vector<std::uint32_t> begin_;  // in edges_, by point
  std::vector<UvEdge> edges_;
  UvIslands islands_;
};

}  // namespace

UvIslands find_islands(const UvSurface& sound) { return IslandFinder(sound).run(); }

}  // namespace gltfx::measure
