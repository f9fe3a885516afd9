// SPDX-License-Identifier: Apache-2.0
#include "measure/uv_overlap.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace gltfx::measure {
namespace {

using PlanePoint = std::array<double, 2>;

constexpr std::size_t kUvPoints = 65536;  // that estimate an area
constexpr std::uint16_t kStrata = 256;    // its square root

std::vector<UvBox> boxes_of(const UvSurface& surface) {
  std::vector<UvBox> boxes(surface.triangles.size());
  for (std::size_t i = 0; i < boxes.size(); ++i) boxes[i] = box_of(surface.corners(i));
  return boxes;
}

// Whether the interiors are apart along the normal of an edge of `one`, or nearly so.
bool separates(const UvTriangle& one, const UvTriangle& other) {
  for (std::size_t edge = 0; edge < 3; ++edge) {
    const UvPoint& from = one[edge];
    const UvPoint& to = one[(edge + 1) % 3];
    const double height = turn(from, to, one[(edge + 2) % 3]);
    const double a = turn(from, to, other[0]);
    const double b = turn(from, to, other[1]);
    const double c = turn(from, to, other[2]);
    const double depth = std::min(std::max(0.0, height), std::max({a, b, c})) -
                         std::max(std::min(0.0, height), std::min({a, b, c}));
    if (depth <= 0) return true;
    const double u = double{to[0]} - double{from[0]};
    const double v = double{to[1]} - double{from[1]};
    if (depth * depth <= kUvNoise * kUvNoise * (u * u + v * v)) return true;
  }
  return false;
}

// Whether the point is on the right of the way from `a` to `b` (positive), or on the left.
double side_of(const UvPoint& a, const UvPoint& b, const PlanePoint& at) {
  return (double{b[0]} - double{a[0]}) * (at[1] - double{a[1]}) -
         (double{b[1]} - double{a[1]}) * (at[0] - double{a[0]});
}

bool is_inside(const UvTriangle& triangle, const PlanePoint& at) {
  const double a = side_of(triangle[0], triangle[1], at);
  const double b = side_of(triangle[1], triangle[2], at);
  const double c = side_of(triangle[2], triangle[0], at);
  return (a > 0 && b > 0 && c > 0) || (a < 0 && b < 0 && c < 0);
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

// Points that fill a square evenly (M. Roberts, "The Unreasonable Effectiveness of Quasirandom
// Sequences", 2018).
PlanePoint even_point(std::size_t i) {
  constexpr PlanePoint kSteps{0.7548776662466927, 0.5698402909980532};
  const auto fraction = [](double number) { return number - std::floor(number); };
  const auto at = static_cast<double>(i) + 0.5;
  return {fraction(at * kSteps[0]), fraction(at * kSteps[1])};
}

PlanePoint point_in(const UvTriangle& triangle, PlanePoint weights) {
  if (weights[0] + weights[1] > 1) weights = {1 - weights[0], 1 - weights[1]};
  PlanePoint point{};
  for (std::size_t k = 0; k < 2; ++k) {
    const double from = double{triangle[0][k]};
    point[k] = from + weights[0] * (double{triangle[1][k]} - from) +
               weights[1] * (double{triangle[2][k]} - from);
  }
  return point;
}

// A grid of points in a rectangle, one at random in each row of its cells, that triangles cover.
// Points that are covered are skipped from then on.
class PointGrid {
 public:
  PointGrid(const PlanePoint& least, const PlanePoint& size) : least_(least), size_(size) {
    for (std::uint32_t i = 0; i < next_.size(); ++i) next_[i] = i;
  }

  void cover(const UvTriangle& triangle, const UvBox& box) {
    const auto step = size_[1] / static_cast<double>(kStrata);
    const double first = std::floor((double{box.least_v} - least_[1]) / step);
    const double last = std::floor((double{box.most_v} - least_[1]) / step);
    constexpr double kLast = static_cast<double>(kStrata) - 1;
    if (!(last >= 0 && first <= kLast)) return;
    const auto end = static_cast<std::size_t>(std::min(last, kLast));
    for (auto row = static_cast<std::size_t>(std::max(first, 0.0)); row <= end; ++row) {
      cover_row(triangle, row);
    }
  }
  double area() const {
    return size_[0] * size_[1] * static_cast<double>(covered_) / static_cast<double>(kUvPoints);
  }

 private:
  // The line through the points of the row crosses the triangle from `least` to `most`.
  void cover_row(const UvTriangle& triangle, std::size_t row) {
    const PlanePoint shift = even_point(row);
    const double v = least_[1] + size_[1] * (static_cast<double>(row) + shift[1]) / kStrata;
    double least = INFINITY;
    double most = -INFINITY;
    for (std::size_t i = 0; i < 3; ++i) {
      const UvPoint& from = triangle[i];
      const UvPoint& to = triangle[(i + 1) % 3];
      if ((double{from[1]} <= v) == (double{to[1]} <= v)) continue;
      const double t = (v - double{from[1]}) / (double{to[1]} - double{from[1]});
      const double u = double{from[0]} + t * (double{to[0]} - double{from[0]});
      least = std::min(least, u);
      most = std::max(most, u);
    }
    const auto column = [&](double u) {
      const double at = (u - least_[0]) / size_[0] * kStrata - shift[0];
      return static_cast<std::size_t>(std::clamp(std::ceil(at), 0.0, double{kStrata}));
    };
    if (least < most) cover_points(row, column(least), column(most));
  }

  void cover_points(std::size_t row, std::size_t begin, std::size_t end) {
    const std::size_t first = row * (kStrata + 1);
    for (std::size_t at = uncovered_from(first + begin); at < first + end;
         at = uncovered_from(at)) {
      next_[at] = static_cast<std::uint32_t>(at + 1);
      ++covered_;
    }
  }

  std::size_t uncovered_from(std::size_t at) {
    while (next_[at] != at) {
      next_[at] = next_[next_[at]];
      at = next_[at];
    }
    return at;
  }

  PlanePoint least_, size_;
  /// By point, and by the end of each row: a later one that may be uncovered; itself if it is.
  std::array<std::uint32_t, kStrata*(kStrata + 1)> next_;
  std::size_t covered_ = 0;
};

}  // namespace

bool share_area(const UvTriangle& one, const UvTriangle& other) {
  return !separates(one, other) && !separates(other, one);
}

UvOverlap::UvOverlap(const UvSurface& sound) : tree_(boxes_of(sound)) {
  const std::size_t n = sound.triangles.size();
  triangles_.reserve(n);
  boxes_.reserve(n);
  for (const std::uint32_t triangle : tree_.order()) {
    triangles_.push_back(sound.corners(triangle));
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
  if (!share_area(triangles_[one], triangles_[other])) return true;
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

// The number of triangles that share area and have the point inside, at most `most`.
std::size_t UvOverlap::count_at(const std::array<double, 2>& at, std::size_t most,
                                std::uint64_t& work) const {
  std::size_t count = 0;
  const auto contains = [&](const UvBox& box) {
    return at[0] >= double{box.least_u} && at[0] <= double{box.most_u} &&
           at[1] >= double{box.least_v} && at[1] <= double{box.most_v};
  };
  tree_.walk([&](std::uint32_t level, std::size_t node) {
    if (count >= most || work == 0) return false;
    --work;
    if (!contains(tree_.level(level)[node])) return false;
    if (level > 0) return true;
    for (std::size_t i = node * BoxTree::kFanout; i < end_of(node) && count < most; ++i) {
      if (shared_[i] != 0 && contains(boxes_[i]) && is_inside(triangles_[i], at)) ++count;
    }
    return true;
  });
  return count;
}

// Points are spread over the triangles; one that k triangles cover stands for 1/k of its area.
std::optional<double> UvOverlap::shared_area() const {
  constexpr std::size_t kMostLayers = 64;
  std::uint64_t work = 64 * (triangles_.size() + kUvPoints);
  double alone = 0;
  double total = 0;
  for (std::size_t i = 0; i < triangles_.size(); ++i) {
    (shared_[i] != 0 ? total : alone) += std::abs(signed_area(triangles_[i]));
  }
  if (total == 0) return 0.0;
  double once = 0;
  double again = 0;
  double before = 0;  // area of the triangles in front of `at`
  std::size_t at = 0;
  for (std::size_t i = 0; i < kUvPoints; ++i) {
    const double wanted = total * (static_cast<double>(i) + 0.5) / static_cast<double>(kUvPoints);
    for (; at + 1 < triangles_.size(); ++at) {
      const double area = shared_[at] != 0 ? std::abs(signed_area(triangles_[at])) : 0;
      if (before + area > wanted) break;
      before += area;
    }
    const std::size_t layers = count_at(point_in(triangles_[at], even_point(i)), kMostLayers, work);
    if (work == 0) return std::nullopt;
    (layers > 1 ? again : once) += 1 / static_cast<double>(std::max<std::size_t>(layers, 1));
  }
  const double each = total / static_cast<double>(kUvPoints);
  return again * each / (alone + (once + again) * each);
}

double UvOverlap::covered_area() const {
  double area = 0;
  UvBox box;
  for (std::size_t i = 0; i < triangles_.size(); ++i) {
    if (shared_[i] != 0) {
      box.include(boxes_[i]);
    } else {
      area += area_in_square(triangles_[i], boxes_[i]);
    }
  }
  if (!box.overlaps({0, 0, 1, 1})) return area;
  const PlanePoint least{std::max(0.0, double{box.least_u}), std::max(0.0, double{box.least_v})};
  PointGrid grid(least, {std::min(1.0, double{box.most_u}) - least[0],
                         std::min(1.0, double{box.most_v}) - least[1]});
  for (std::size_t i = 0; i < triangles_.size(); ++i) {
    if (shared_[i] != 0) grid.cover(triangles_[i], boxes_[i]);
  }
  return std::min(1.0, area + grid.area());
}

}  // namespace gltfx::measure
