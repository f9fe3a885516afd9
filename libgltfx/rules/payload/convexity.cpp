// SPDX-License-Identifier: Apache-2.0
#include "rules/payload/convexity.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <utility>
#include <vector>

namespace gltfx::validate {
namespace {

constexpr double kBeyondAll = std::numeric_limits<double>::infinity();
constexpr std::uint64_t kFreeWork = std::uint64_t{1} << 26U;  // boxes and vertices
constexpr std::uint64_t kWorkOfTriangle = 1U << 11U;

struct PlaneOfTriangle {
  Vec3d normal;       ///< of length 1
  double offset = 0;  ///< of its points along the normal
  /// By how much points may be off because positions are rounded: narrow triangles turn.
  double rounding = 0;
};

/// Points in boxes, in the order of a curve through space; eight boxes are in each larger one.
class PointTree {
 public:
  explicit PointTree(const std::vector<Float3>& points) {
    for (const Float3& each : points) all_.add(to_vec(each));
    sort(points);
    std::vector<Bounds> level((points_.size() + kFanout - 1) / kFanout);
    for (std::size_t i = 0; i < points_.size(); ++i) level[i / kFanout].add(points_[i]);
    levels_.push_back(std::move(level));
    while (levels_.back().size() > 1) {
      const std::vector<Bounds>& below = levels_.back();
      std::vector<Bounds> above((below.size() + kFanout - 1) / kFanout);
      for (std::size_t i = 0; i < below.size(); ++i) above[i / kFanout].add(below[i]);
      levels_.push_back(std::move(above));
    }
  }

  double diagonal() const { return length(all_.most - all_.least); }
  double reach() const { return std::max(length(all_.most), length(all_.least)); }

  /// Whether a point is farther along a direction than `limit`. Takes its steps from `work`, and
  /// stops at 0.
  bool reaches(const Vec3d& along, double limit, std::uint64_t& work) const {
    std::array<std::pair<std::uint32_t, std::uint32_t>, kMostLevels * kFanout> open;
    std::size_t count = 0;
    open[count++] = {static_cast<std::uint32_t>(levels_.size() - 1), 0};
    while (count > 0 && work > 0) {
      --work;
      const auto [level, box] = open[--count];
      if (levels_[level][box].most_along(along) <= limit) continue;
      const std::size_t first = std::size_t{box} * kFanout;
      if (level == 0) {
        for (std::size_t i = first; i < std::min(first + kFanout, points_.size()); ++i) {
          if (dot(along, points_[i]) > limit) return true;
        }
        continue;
      }
      const std::size_t last = std::min(first + kFanout, levels_[level - 1].size());
      for (std::size_t child = first; child < last; ++child) {
        open[count++] = {level - 1, static_cast<std::uint32_t>(child)};
      }
    }
    return false;
  }

 private:
  static constexpr std::size_t kFanout = 8, kMostLevels = 11;

  struct Bounds {
    Vec3d least{kBeyondAll, kBeyondAll, kBeyondAll};
    Vec3d most{-kBeyondAll, -kBeyondAll, -kBeyondAll};
    void add(const Vec3d& p) { add(Bounds{p, p}); }
    void add(const Bounds& other) {
      least = {std::min(least.x, other.least.x), std::min(least.y, other.least.y),
               std::min(least.z, other.least.z)};
      most = {std::max(most.x, other.most.x), std::max(most.y, other.most.y),
              std::max(most.z, other.most.z)};
    }
    double most_along(const Vec3d& n) const {
      return n.x * (n.x > 0 ? most.x : least.x) + n.y * (n.y > 0 ? most.y : least.y) +
             n.z * (n.z > 0 ? most.z : least.z);
    }
  };

  static std::uint64_t spread(double part) {
    auto bits = static_cast<std::uint64_t>(std::clamp(part, 0.0, 1.0) * 0x1FFFFF);
    bits = (bits | bits << 32U) & 0x001F00000000FFFFU;
    bits = (bits | bits << 16U) & 0x001F0000FF0000FFU;
    bits = (bits | bits << 8U) & 0x100F00F00F00F00FU;
    bits = (bits | bits << 4U) & 0x10C30C30C30C30C3U;
    return (bits | bits << 2U) & 0x1249249249249249U;
  }

  void sort(const std::vector<Float3>& points) {
    const Vec3d size = all_.most - all_.least;
    const auto part = [](double at, double least, double width) {
      return width > 0 ? (at - least) / width : 0;
    };
    std::vector<std::pair<std::uint64_t, std::uint32_t>> order;
    order.reserve(points.size());
    for (const Float3& each : points) {
      const Vec3d p = to_vec(each);
      order.emplace_back(spread(part(p.x, all_.least.x, size.x)) |
                             spread(part(p.y, all_.least.y, size.y)) << 1U |
                             spread(part(p.z, all_.least.z, size.z)) << 2U,
                         static_cast<std::uint32_t>(order.size()));
    }
    std::sort(order.begin(), order.end());
    points_.reserve(points.size());
    for (const auto& [key, at] : order) points_.push_back(to_vec(points[at]));
  }

  std::vector<Vec3d> points_;
  std::vector<std::vector<Bounds>> levels_;
  Bounds all_;
};

class ConvexitySearch {
 public:
  explicit ConvexitySearch(const measure::Surface& surface)
      : surface_(surface), tree_(surface.positions) {}

  Convexity run() {
    found_.triangles = surface_.triangles.size();
    found_.diagonal = tree_.diagonal();
    if (is_flat()) {
      found_.kind = Convexity::Kind::flat;
      return found_;
    }
    work_ = kFreeWork + kWorkOfTriangle * surface_.triangles.size();
    for (std::size_t i = 0; i < surface_.triangles.size(); ++i) {
      if (!judge(i)) return found_;
      if (work_ == 0) return {};
    }
    found_.kind = Convexity::Kind::convex;
    return found_;
  }

 private:
  PlaneOfTriangle plane_of(std::size_t triangle) const {
    constexpr double kRounding = 1.0 / (1U << 22U);
    const auto& [ia, ib, ic] = surface_.triangles[triangle];
    const Vec3d a = to_vec(surface_.positions[ia]), b = to_vec(surface_.positions[ib]),
                c = to_vec(surface_.positions[ic]);
    PlaneOfTriangle plane{surface_.normals[triangle], 0, 0};
    plane.offset = dot(plane.normal, (a + b + c) / 3);
    const double longest = std::max({length(b - a), length(c - b), length(a - c)});
    const double height = length(cross(b - a, c - a)) / longest;
    const double off = tree_.reach() * kRounding;
    plane.rounding = off * (1 + 2 * found_.diagonal / height);
    return plane;
  }

  // By the plane of the largest triangle.
  bool is_flat() const {
    std::size_t largest = 0;
    double most = 0;
    for (std::size_t i = 0; i < surface_.triangles.size(); ++i) {
      const auto& [a, b, c] = surface_.triangles[i];
      const Vec3d origin = to_vec(surface_.positions[a]);
      const double area = length(
          cross(to_vec(surface_.positions[b]) - origin, to_vec(surface_.positions[c]) - origin));
      if (area > most) largest = i;
      most = std::max(most, area);
    }
    const PlaneOfTriangle plane = plane_of(largest);
    const double limit = found_.diagonal * kFlatTolerance;
    return std::all_of(surface_.positions.begin(), surface_.positions.end(),
                       [&](const Float3& each) {
                         return std::abs(dot(plane.normal, to_vec(each)) - plane.offset) <= limit;
                       });
  }

  // The same for triangles in one plane, of which flat sides may have many.
  using PlaneKey = std::array<std::int64_t, 4>;
  PlaneKey key_of(const PlaneOfTriangle& plane) const {
    constexpr double kSteps = 4 / kDentTolerance;
    return {std::llround(plane.normal.x * kSteps), std::llround(plane.normal.y * kSteps),
            std::llround(plane.normal.z * kSteps),
            std::llround(plane.offset / found_.diagonal * kSteps)};
  }

  // False: the body is dented.
  bool judge(std::size_t triangle) {
    const PlaneOfTriangle plane = plane_of(triangle);
    const double tolerance = found_.diagonal * kDentTolerance + plane.rounding;
    const auto [known, is_new] = faces_inward_.try_emplace(key_of(plane), false);
    if (is_new) {
      const Vec3d back = Vec3d() - plane.normal;
      known->second = tree_.reaches(plane.normal, plane.offset + tolerance, work_);
      if (known->second && tree_.reaches(back, tolerance - plane.offset, work_)) {
        measure_dent(plane);
        return false;
      }
    }
    if (known->second) ++found_.inward;
    const double outside = known->second ? plane.offset : -plane.offset;
    if (outside > tolerance) found_.origin_outside = std::max(found_.origin_outside, outside);
    return true;
  }

  void measure_dent(const PlaneOfTriangle& plane) {
    double above = 0;
    double below = 0;
    for (const Float3& each : surface_.positions) {
      const double at = dot(plane.normal, to_vec(each)) - plane.offset;
      above = std::max(above, at);
      below = std::max(below, -at);
    }
    found_.kind = Convexity::Kind::dented;
    found_.depth = std::min(above, below);
  }

  const measure::Surface& surface_;
  const PointTree tree_;
  std::uint64_t work_ = 0;
  Convexity found_;
  std::map<PlaneKey, bool> faces_inward_;
};

}  // namespace

Convexity find_convexity(const measure::Surface& surface) {
  if (!std::isfinite(surface.area)) return {};
  if (surface.triangles.empty()) {
    Convexity none;
    if (surface.degenerate > 0) none.kind = Convexity::Kind::flat;
    return none;
  }
  return ConvexitySearch(surface).run();
}

}  // namespace gltfx::validate
