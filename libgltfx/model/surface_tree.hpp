// SPDX-License-Identifier: Apache-2.0
/// Distances of points to triangles.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "model/node.hpp"

namespace gltfx::model {

/// Triangles, and the points that they refer to. Keeps references only.
struct Surface {
  std::span<const std::array<float, 3>> points;
  std::span<const std::uint32_t> corners;  ///< three for each triangle, all of them points

  std::size_t triangles() const { return corners.size() / 3; }
  Vector3 corner(std::size_t at) const {
    const std::array<float, 3>& point = points[corners[at]];
    return {double{point[0]}, double{point[1]}, double{point[2]}};
  }
};

/// The point of a triangle that is nearest to another one, as weights of its corners.
Vector3 nearest_weights(const Vector3& to, const Vector3& a, const Vector3& b, const Vector3& c);

/// A balanced tree of boxes over the triangles of a surface: takes n log n time and 10 bytes per
/// triangle, whatever their sizes and places. Precondition: all points are finite. Read-only.
class SurfaceTree {
 public:
  explicit SurfaceTree(const Surface& surface);
  const Surface& surface() const { return surface_; }

  struct Nearest {
    double distance = 0;
    std::uint32_t triangle = 0;
    std::uint32_t work = 0;  ///< the boxes that were looked at
  };
  /// The distance of a point; infinite without triangles. Stops at the first triangle that is not
  /// farther away than `enough`. `hint`: a triangle that may be near.
  Nearest nearest(const Vector3& point, double enough, std::uint32_t hint) const;

  /// Calls `visit` with triangles whose box is not farther away than `radius`, as long as it
  /// returns true.
  template <class Visit>
  void each_near(const Vector3& point, double radius, const Visit& visit) const;

 private:
  static constexpr std::uint32_t kLeaf = 4;  ///< most triangles of a leaf
  static constexpr std::size_t kDeepest = 64;

  /// Children of a node are neighbours. A leaf has a count.
  struct Node {
    std::array<float, 3> least, greatest;
    std::uint32_t first = 0;  ///< the first child, or the place of the first triangle
    std::uint32_t count = 0;  ///< of triangles; 0: not a leaf
  };

  double square_to(std::uint32_t node, const Vector3& point) const;
  double square_to_triangle(std::uint32_t triangle, const Vector3& point) const;
  void enclose(Node& node, std::uint32_t first, std::uint32_t count) const;

  const Surface surface_;
  std::vector<std::uint32_t> order_;  ///< triangles by place
  std::vector<Node> nodes_;           ///< the first one is the root
};

template <class Visit>
void SurfaceTree::each_near(const Vector3& point, double radius, const Visit& visit) const {
  if (nodes_.empty()) return;
  std::array<std::uint32_t, kDeepest> open{};
  std::size_t count = 0;
  open[count++] = 0;
  while (count > 0) {
    const std::uint32_t index = open[--count];
    if (square_to(index, point) > radius * radius) continue;
    const Node& node = nodes_[index];
    if (node.count == 0) {
      open[count++] = node.first;
      open[count++] = node.first + 1;
    }
    for (std::uint32_t i = 0; i < node.count; ++i) {
      if (!visit(order_[node.first + i])) return;
    }
  }
}

}  // namespace gltfx::model
