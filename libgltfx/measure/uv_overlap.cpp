// SPDX-License-Identifier: Apache-2.0
#include "measure/uv_overlap.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace gltfx::measure {
namespace {

using PlanePoint = std::array<double, 2>;

std::vector<UvBox> boxes_of(const UvSurface& surface) {
  std::vector<UvBox> boxes(surface.triangles.size());
  for (std::size_t i = 0; i < boxes.size(); ++i) boxes[i] = box_of(surface.corners(i));
  return boxes;
}

// Whether all of `other` is outside of an edge of `one`.
bool is_apart(const UvTriangle& one, const UvTriangle& other) {
  for (std::size_t edge = 0; edge < 3; ++edge) {
    const UvPoint& from = one[edge];
    const UvPoint& to = one[(edge + 1) % 3];
    if (turn(from, to, other[0]) <= 0 && turn(from, to, other[1]) <= 0 &&
        turn(from, to, other[2]) <= 0) {
      return true;
    }
  }
  return false;
}

// Whether the depth along the normal of an edge of `one` is noise.
bool barely_meets(const UvTriangle& one, const UvTriangle& other) {
  for (std::size_t edge = 0; edge < 3; ++edge) {
    const UvPoint& from = one[edge];
    const UvPoint& to = one[(edge + 1) % 3];
    const double a = turn(from, to, other[0]);
    const double b = turn(from, to, other[1]);
    const double c = turn(from, to, other[2]);
    const double height = turn(from, to, one[(edge + 2) % 3]);
    const double depth = std::min(height, std::max({a, b, c})) - std::max(0.0, std::min({a, b, c}));
    const double u = double{to[0]} - double{from[0]};
    const double v = double{to[1]} - double{from[1]};
    if (depth <= 0 || depth * depth <= kUvNoise * kUvNoise * (u * u + v * v)) return true;
  }
  return false;
}

// Whether two triangles share area. Precondition: none is mirrored the other way: the third corner
// of each is on the positive side.
bool turned_share_area(const UvTriangle& one, const UvTriangle& other) {
  return !is_apart(one, other) && !is_apart(other, one) && !barely_meets(one, other) &&
         !barely_meets(other, one);
}

UvTriangle turned(UvTriangle triangle) {
  if (signed_area(triangle) < 0) std::swap(triangle[1], triangle[2]);
  return triangle;
}

// The part of a convex polygon where `sign * coordinate <= limit`.
struct ClippedPolygon {
  std::array<PlanePoint, 8> corners{};
  std::size_t count = 0;

  void add(const PlanePoint& corner) { corners[count++] = corner; }
  ClippedPolygon part(std::size_t axis, double sign, double limit) const {
    ClippedPolygon part;
    for (std::size_t i = 0; i < count; ++i) {
      const auto& from = corners[i];
      const auto& to = corners[(i + 1) % count];
      const double before = limit - sign * from[axis];
      const double after = limit - sign * to[axis];
      if (before >= 0) part.add(from);
      if ((before < 0) == (after < 0)) continue;
      const double t = before / (before - after);
      part.add({from[0] + t * (to[0] - from[0]), from[1] + t * (to[1] - from[1])});
    }
    return part;
  }
  double area() const {
    double twice = 0;
    for (std::size_t i = 0; i < count; ++i) {
      const auto& from = corners[i];
      const auto& to = corners[(i + 1) % count];
      twice += from[0] * to[1] - from[1] * to[0];
    }
    return std::abs(twice) / 2;
  }
};

// In the square from 0 to 1.
double area_in_square(const UvTriangle& triangle, const UvBox& box) {
  if (box.least_u >= 0 && box.least_v >= 0 && box.most_u <= 1 && box.most_v <= 1) {
    return std::abs(signed_area(triangle));
  }
  if (!box.overlaps({0, 0, 1, 1})) return 0;
  ClippedPolygon polygon;
  for (const UvPoint& corner : triangle) polygon.add({double{corner[0]}, double{corner[1]}});
  for (const std::size_t axis : {0U, 1U}) polygon = polygon.part(axis, -1, 0).part(axis, 1, 1);
  return polygon.area();
}

}  // namespace

bool share_area(const UvTriangle& one, const UvTriangle& other) {
  return turned_share_area(turned(one), turned(other));
}

UvOverlap::UvOverlap(const UvSurface& sound) : tree_(boxes_of(sound)) {
  const std::size_t n = sound.triangles.size();
  triangles_.reserve(n);
  boxes_.reserve(n);
  for (const std::uint32_t triangle : tree_.order()) {
    triangles_.push_back(turned(sound.corners(triangle)));
    boxes_.push_back(box_of(triangles_.back()));
  }
  shared_.resize(n);
  std::size_t below = n;
  for (std::size_t level = 0; level < std::max<std::size_t>(tree_.height(), 1); ++level) {
    const std::size_t nodes =
        std::max<std::size_t>((below + BoxTree::kFanout - 1) / BoxTree::kFanout, 1);
    std::vector<std::uint32_t> alone(nodes);
    for (std::size_t i = 0; i < below; ++i) {
      alone[i / BoxTree::kFanout] += level == 0 ? 1 : alone_.back()[i];
    }
    alone_.push_back(std::move(alone));
    below = nodes;
  }
  constexpr std::uint64_t kFewPairs = 65536;
  pairs_left_ = kFewPairs + 64 * n;
  leaves_left_ = kFewPairs + 16 * n;
  nodes_left_ = kFewPairs + 64 * n;
}

std::size_t UvOverlap::end_of(std::size_t leaf) const {
  return std::min((leaf + 1) * BoxTree::kFanout, triangles_.size());
}

void UvOverlap::mark(std::size_t triangle) {
  if (shared_[triangle] != 0) return;
  shared_[triangle] = 1;
  std::size_t node = triangle;
  for (auto& level : alone_) {
    node /= BoxTree::kFanout;
    --level[node];
  }
}

bool UvOverlap::test(std::size_t one, std::size_t other) {
  if (shared_[one] != 0 && shared_[other] != 0) return true;
  if (!boxes_[one].overlaps(boxes_[other])) return true;
  if (pairs_left_ == 0) return false;
  --pairs_left_;
  if (!turned_share_area(triangles_[one], triangles_[other])) return true;
  mark(one);
  mark(other);
  return true;
}

bool UvOverlap::test_leaves(std::size_t one, std::size_t other) {
  const UvBox& box = tree_.level(0)[other];
  for (std::size_t i = one * BoxTree::kFanout; i < end_of(one); ++i) {
    if (!boxes_[i].overlaps(box)) continue;
    for (std::size_t j = other * BoxTree::kFanout; j < end_of(other); ++j) {
      if (!test(i, j)) return false;
    }
  }
  return true;
}

bool UvOverlap::test_against_later(std::size_t leaf) {
  const UvBox box = tree_.level(0)[leaf];
  bool left = true;
  tree_.walk([&](std::uint32_t level, std::size_t node) {
    if (!left || ((node + 1) << 3U * level) <= leaf + 1) return false;  // no later leaf is in it
    if (alone_[level][node] == 0 && alone_[0][leaf] == 0) return false;
    if (nodes_left_ == 0) return left = false;
    --nodes_left_;
    if (!tree_.level(level)[node].overlaps(box)) return false;
    if (level > 0) return true;
    if (leaves_left_ == 0) return left = false;
    --leaves_left_;
    return left = test_leaves(leaf, node);
  });
  return left;
}

// Neighbours first: where surfaces lie on each other, nothing is left to be compared then.
bool UvOverlap::find() {
  for (std::size_t leaf = 0; leaf < tree_.leaves(); ++leaf) {
    for (std::size_t i = leaf * BoxTree::kFanout; i < end_of(leaf); ++i) {
      for (std::size_t j = i + 1; j < end_of(leaf); ++j) {
        if (!test(i, j)) return false;
      }
    }
  }
  for (std::size_t leaf = 0; leaf < tree_.leaves(); ++leaf) {
    if (!test_against_later(leaf)) return false;
  }
  return true;
}

std::optional<UvCover> UvOverlap::cover() const {
  std::vector<UvTriangle> shared;
  double alone = 0;
  double in_square = 0;
  for (std::size_t i = 0; i < triangles_.size(); ++i) {
    if (shared_[i] != 0) {
      shared.push_back(triangles_[i]);
    } else {
      alone += std::abs(signed_area(triangles_[i]));
      in_square += area_in_square(triangles_[i], boxes_[i]);
    }
  }
  std::optional<UvCover> cover = estimate_cover(shared);
  if (!cover) return std::nullopt;
  cover->once += alone;
  cover->in_square += in_square;
  return cover;
}

}  // namespace gltfx::measure
