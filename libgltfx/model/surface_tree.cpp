// SPDX-License-Identifier: Apache-2.0
#include "model/surface_tree.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

namespace gltfx::model {
namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();

Vector3 from_to(const Vector3& a, const Vector3& b) {
  return {b[0] - a[0], b[1] - a[1], b[2] - a[2]};
}

// 0 for triangles without area, whose points all are near a corner or an edge.
double part(double of, double whole) { return whole > 0 ? std::clamp(of / whole, 0.0, 1.0) : 0; }

/// Triangles [first, first + count) of the order become a node.
struct Range {
  std::uint32_t node, first, count;
};

}  // namespace

// Ericson, "Real-Time Collision Detection", 2005, section 5.1.5: by the regions of the corners and
// edges.
Vector3 nearest_weights(const Vector3& to, const Vector3& a, const Vector3& b, const Vector3& c) {
  const Vector3 ab = from_to(a, b), ac = from_to(a, c);
  const Vector3 at_a = from_to(a, to), at_b = from_to(b, to), at_c = from_to(c, to);
  const double d1 = dot(ab, at_a), d2 = dot(ac, at_a);
  if (d1 <= 0 && d2 <= 0) return {1, 0, 0};
  const double d3 = dot(ab, at_b), d4 = dot(ac, at_b);
  if (d3 >= 0 && d4 <= d3) return {0, 1, 0};
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) {
    const double v = part(d1, d1 - d3);
    return {1 - v, v, 0};
  }
  const double d5 = dot(ab, at_c), d6 = dot(ac, at_c);
  if (d6 >= 0 && d5 <= d6) return {0, 0, 1};
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0 && d2 >= 0 && d6 <= 0) {
    const double w = part(d2, d2 - d6);
    return {1 - w, 0, w};
  }
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0 && d4 >= d3 && d5 >= d6) {
    const double w = part(d4 - d3, (d4 - d3) + (d5 - d6));
    return {0, 1 - w, w};
  }
  const double v = part(vb, va + vb + vc), w = part(vc, va + vb + vc);
  return {1 - v - w, v, w};
}

SurfaceTree::SurfaceTree(const Surface& surface) : surface_(surface), order_(surface.triangles()) {
  const auto triangles = static_cast<std::uint32_t>(order_.size());
  if (triangles == 0) return;
  std::iota(order_.begin(), order_.end(), 0U);
  std::array<std::vector<float>, 3> sums;  // of the corners, by axis
  for (std::size_t axis = 0; axis < 3; ++axis) {
    sums[axis].resize(triangles);
    for (std::size_t i = 0; i < triangles; ++i) {
      double sum = 0;
      for (std::size_t k = 0; k < 3; ++k) sum += surface_.corner(3 * i + k)[axis];
      sums[axis][i] = static_cast<float>(sum / 3);
    }
  }
  nodes_.reserve(triangles);
  nodes_.emplace_back();
  std::vector<Range> open{{0, 0, triangles}};
  while (!open.empty()) {
    const Range range = open.back();
    open.pop_back();
    enclose(nodes_[range.node], range.first, range.count);
    Node& node = nodes_[range.node];
    if (range.count <= kLeaf) {
      node.first = range.first;
      node.count = range.count;
      continue;
    }
    std::size_t axis = 0;
    for (std::size_t i = 1; i < 3; ++i) {
      if (node.greatest[i] - node.least[i] > node.greatest[axis] - node.least[axis]) axis = i;
    }
    const std::uint32_t half = range.count / 2;
    const auto begin = order_.begin() + range.first;
    std::nth_element(begin, begin + half, begin + range.count,
                     [&key = sums[axis]](std::uint32_t a, std::uint32_t b) {
                       return std::pair(key[a], a) < std::pair(key[b], b);
                     });
    const auto child = static_cast<std::uint32_t>(nodes_.size());
    node.first = child;
    nodes_.resize(nodes_.size() + 2);
    open.push_back({child, range.first, half});
    open.push_back({child + 1, range.first + half, range.count - half});
  }
}

void SurfaceTree::enclose(Node& node, std::uint32_t first, std::uint32_t count) const {
  constexpr float kFar = std::numeric_limits<float>::infinity();
  node.least = {kFar, kFar, kFar};
  node.greatest = {-kFar, -kFar, -kFar};
  for (std::uint32_t i = first; i < first + count; ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      const auto& point = surface_.points[surface_.corners[std::size_t{3} * order_[i] + k]];
      for (std::size_t axis = 0; axis < 3; ++axis) {
        node.least[axis] = std::min(node.least[axis], point[axis]);
        node.greatest[axis] = std::max(node.greatest[axis], point[axis]);
      }
    }
  }
}

double SurfaceTree::square_to(std::uint32_t node, const Vector3& point) const {
  double square = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const double off = std::max({double{nodes_[node].least[i]} - point[i],
                                 point[i] - double{nodes_[node].greatest[i]}, 0.0});
    square += off * off;
  }
  return square;
}

double SurfaceTree::square_to_triangle(std::uint32_t triangle, const Vector3& point) const {
  const std::size_t at = std::size_t{3} * triangle;
  const Vector3 a = surface_.corner(at), b = surface_.corner(at + 1), c = surface_.corner(at + 2);
  const Vector3 weights = nearest_weights(point, a, b, c);
  double square = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const double off = weights[0] * a[i] + weights[1] * b[i] + weights[2] * c[i] - point[i];
    square += off * off;
  }
  return square;
}

SurfaceTree::Nearest SurfaceTree::nearest(const Vector3& point, double enough,
                                          std::uint32_t hint) const {
  if (nodes_.empty()) return {kNever, 0, 0};
  double best = square_to_triangle(hint, point);
  const double limit = enough * enough;
  struct Step {
    std::uint32_t node;
    double square;
  };
  std::array<Step, kDeepest> open;
  std::size_t count = 0;
  std::uint32_t work = 0;
  open[count++] = {0, square_to(0, point)};
  while (count > 0 && best > limit) {
    const Step step = open[--count];
    ++work;
    if (step.square >= best) continue;
    const Node& node = nodes_[step.node];
    for (std::uint32_t i = 0; i < node.count; ++i) {
      const double square = square_to_triangle(order_[node.first + i], point);
      if (square >= best) continue;
      best = square;
      hint = order_[node.first + i];
    }
    if (node.count > 0) continue;
    Step near{node.first, square_to(node.first, point)};
    Step far{node.first + 1, square_to(node.first + 1, point)};
    if (far.square < near.square) std::swap(near, far);
    open[count++] = far;
    open[count++] = near;
  }
  return {std::sqrt(best), hint, work};
}

}  // namespace gltfx::model
