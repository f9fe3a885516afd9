// SPDX-License-Identifier: Apache-2.0
#include "preview/framing_strays.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "base/disjoint_sets.hpp"
#include "base/packed.hpp"
#include "preview/framing_faces.hpp"

namespace gltfx::preview {
namespace {

// Scenes that these numbers and those of drop_islands() distinguish are in
// tests/preview/framing_test.cpp.
constexpr double kStrayFactor = 3;  // maximum distance of a point from the middle, in core extents

// The range of points of the subject along one axis.
std::pair<double, double> limits_along(const std::vector<Float3>& points, std::size_t axis) {
  std::vector<float> values;
  values.reserve(points.size());
  for (const Float3& p : points) values.push_back(p[axis]);
  const auto at = [&values](std::size_t index) {
    const auto place = values.begin() + static_cast<std::ptrdiff_t>(index);
    std::nth_element(values.begin(), place, values.end());
    return *place;
  };
  const double low = at(values.size() / 100);
  const double high = at(values.size() - 1 - values.size() / 100);
  return {low, high};
}

// A plane has no extent along one axis, so distances are relative to the longest one. Triangles are
// removed as a whole: otherwise the edge of the picture would cut through them.
void drop_far_corners(Subject& subject) {
  std::array<std::pair<double, double>, 3> core;
  double longest = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    core[axis] = limits_along(subject.points, axis);
    longest = std::max(longest, core[axis].second - core[axis].first);
  }
  if (!(longest > 0)) return;
  const auto strays = [&](const Float3& p) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double middle = (core[axis].first + core[axis].second) / 2;
      if (std::fabs(static_cast<double>(p[axis]) - middle) > kStrayFactor * longest) return true;
    }
    return false;
  };
  keep_faces(subject, [&](std::size_t face) {
    const auto first = subject.points.begin() + static_cast<std::ptrdiff_t>(3 * face);
    return std::none_of(first, first + 3, strays);
  });
}

/// Connected components of the cells of a grid, by triangles and neighbours.
class Cells {
 public:
  explicit Cells(const Subject& subject) : filled_(kCells, 0), components_(kCells) {
    FaceBox box;
    for (const Float3& p : subject.points) box.add(to_vec(p));
    least_ = box.least;
    const Vec3d extent = box.greatest - box.least;
    width_ = std::max({extent.x, extent.y, extent.z, 1e-30}) / kAlong;
    for (std::size_t i = 0; i < subject.points.size(); i += 3) {
      const std::uint32_t first = cell_of(subject.points[i]);
      filled_[first] = 1;
      for (std::size_t k = 1; k < 3; ++k) {
        const std::uint32_t other = cell_of(subject.points[i + k]);
        filled_[other] = 1;
        components_.join(first, other);
      }
    }
    join_neighbours();
  }

  /// The cell that represents the component of a cell.
  std::uint32_t root_of(const Float3& point) { return components_.find(cell_of(point)); }
  static constexpr std::uint32_t kAlong = 32;
  static constexpr std::uint32_t kCells = kAlong * kAlong * kAlong;

 private:
  std::uint32_t cell_of(const Float3& point) const {
    const Vec3d p = (to_vec(point) - least_) / width_;
    const auto along = [](double x) {
      return static_cast<std::uint32_t>(std::clamp(x, 0.0, kAlong - 0.5));
    };
    return (along(p.z) * kAlong + along(p.y)) * kAlong + along(p.x);
  }

  void join_neighbours() {
    for (std::uint32_t cell = 0; cell < kCells; ++cell) {
      if (filled_[cell] == 0) continue;
      const std::array<std::uint32_t, 3> at{cell % kAlong, cell / kAlong % kAlong,
                                            cell / (kAlong * kAlong)};
      const auto most = [&at](std::size_t axis) { return std::min(at[axis] + 2, kAlong); };
      for (std::uint32_t z = at[2]; z < most(2); ++z) {
        for (std::uint32_t y = at[1] - std::min(at[1], 1U); y < most(1); ++y) {
          for (std::uint32_t x = at[0] - std::min(at[0], 1U); x < most(0); ++x) {
            const std::uint32_t other = (z * kAlong + y) * kAlong + x;
            if (filled_[other] != 0) components_.join(cell, other);
          }
        }
      }
    }
  }

  std::vector<std::uint8_t> filled_;
  DisjointSets components_;
  Vec3d least_;
  double width_ = 1;
};

struct Island {
  FaceBox box;
  double area = 0;
};

// By cells. Empty if there is one component.
std::vector<std::pair<std::size_t, Island>> islands_of(const Subject& subject, Cells& cells) {
  std::vector<Island> by_cell(Cells::kCells);
  for (std::size_t i = 0; i < subject.faces.size(); ++i) {
    Island& island = by_cell[cells.root_of(subject.points[3 * i])];
    island.area += length(area_vector(subject, i)) / 2;
    for (std::size_t k = 0; k < 3; ++k) island.box.add(to_vec(subject.points[3 * i + k]));
  }
  std::vector<std::pair<std::size_t, Island>> islands;
  for (std::size_t i = 0; i < by_cell.size(); ++i) {
    if (by_cell[i].box.least.x <= by_cell[i].box.greatest.x) islands.emplace_back(i, by_cell[i]);
  }
  return islands;
}

// Which islands are small beside the main one, and apart from it.
struct StrayRule {
  double small;   // part of the size of the main one
  double apart;   // distance in sizes of the main one
  double little;  // all of them together: part of the area of the main one
  double gain;    // how much larger the picture becomes without them
};
constexpr std::array<StrayRule, 2> kStrayRules{{
    {1.0 / 8, 1.0 / 4, 1.0 / 100, 1}, {1.0 / 4, 1.0 / 4, 1.0 / 30, 1.5},  // a figure beside a house
}};

// True if triangles were removed: the rest may have finer parts.
bool drop_islands(Subject& subject, const StrayRule& rule) {
  Cells cells(subject);
  const auto islands = islands_of(subject, cells);
  const Island& main =
      std::max_element(islands.begin(), islands.end(), [](const auto& a, const auto& b) {
        return a.second.area < b.second.area;
      })->second;
  const double size = main.box.size();
  std::vector<std::uint8_t> strays(Cells::kCells, 0);
  double area = 0;
  FaceBox all, kept;
  for (const auto& [cell, island] : islands) {
    all.add(island.box);
    const bool small = island.box.size() < rule.small * size;
    if (!small || island.box.distance(main.box) <= rule.apart * size) {
      kept.add(island.box);
      continue;
    }
    strays[cell] = 1;
    area += island.area;
  }
  if (std::count(strays.begin(), strays.end(), 1) == 0 || area > rule.little * main.area ||
      all.size() < rule.gain * kept.size()) {
    return false;
  }
  keep_faces(subject, [&](std::size_t face) {
    return strays[cells.root_of(subject.points[3 * face])] == 0;
  });
  return true;
}

}  // namespace

void drop_strays(Subject& subject) {
  constexpr int kMostRounds = 8;
  drop_far_corners(subject);
  for (const StrayRule& rule : kStrayRules) {
    for (int i = 0; i < kMostRounds && drop_islands(subject, rule); ++i) continue;
  }
}

}  // namespace gltfx::preview
