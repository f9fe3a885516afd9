// SPDX-License-Identifier: Apache-2.0
#include "measure/uv_cover.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <vector>

namespace gltfx::measure {
namespace {

constexpr std::size_t kCells = 256;  // along an axis, about

// Lines between cells: at corners, 0 and 1, and between those.
std::vector<double> lines_of(std::span<const UvTriangle> triangles, std::size_t axis) {
  constexpr std::size_t kFewTriangles = 16384;
  std::vector<double> at{0, 1};
  double least = INFINITY;
  double most = -INFINITY;
  const std::size_t step = triangles.size() / kFewTriangles + 1;
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    for (const UvPoint& corner : triangles[i]) {
      const double value{corner[axis]};
      least = std::min(least, value);
      most = std::max(most, value);
      if (i % step == 0) at.push_back(value);
    }
  }
  at.insert(at.end(), {least, most});
  std::erase_if(at, [&](double value) { return value < least || value > most; });
  std::sort(at.begin(), at.end());
  std::vector<double> lines;
  const std::size_t often = at.size() / kCells + 1;
  for (std::size_t i = 0; i < at.size(); i += often) lines.push_back(at[i]);
  // Those of the unit square matter, because what is outside does not count.
  for (const double value : {0.0, 1.0, most}) {
    if (value >= least && value <= most) lines.push_back(value);
  }
  std::sort(lines.begin(), lines.end());
  lines.erase(std::unique(lines.begin(), lines.end()), lines.end());
  const std::size_t parts = kCells / lines.size() + 1;
  std::vector<double> all;
  for (std::size_t i = 0; i + 1 < lines.size(); ++i) {
    for (std::size_t k = 0; k < parts; ++k) {
      const double t = static_cast<double>(k) / static_cast<double>(parts);
      all.push_back(lines[i] + t * (lines[i + 1] - lines[i]));
    }
  }
  all.push_back(lines.back());
  return all;
}

// Finds the next one that is not done, along a list; done ones are skipped at once.
class SkipList {
 public:
  explicit SkipList(std::size_t count) : next_(count + 1) {
    std::iota(next_.begin(), next_.end(), std::uint32_t{0});
  }
  std::size_t from(std::size_t at) {
    while (next_[at] != at) {
      next_[at] = next_[next_[at]];
      at = next_[at];
    }
    return at;
  }
  void remove(std::size_t at) { next_[at] = static_cast<std::uint32_t>(at + 1); }

 private:
  std::vector<std::uint32_t> next_;  // by element: itself, or a later one
};

// One point in each cell; the points of a row are on one line.
class CoverGrid {
 public:
  explicit CoverGrid(std::span<const UvTriangle> triangles)
      : columns_(lines_of(triangles, 0)),
        rows_(lines_of(triangles, 1)),
        width_(columns_.size() - 1),
        open_rows_(rows_.size() - 1),
        open_points_(width_ * (rows_.size() - 1)),
        left_(rows_.size() - 1, width_),
        hits_(width_ * (rows_.size() - 1)) {
    constexpr std::uint64_t kFewRows = 1U << 16U;
    work_ = kFewRows + 16 * std::uint64_t{triangles.size()};
  }

  // False: out of work.
  bool add(const UvTriangle& triangle) {
    const UvBox box = box_of(triangle);
    const std::size_t end = after(rows_, double{box.most_v});
    for (std::size_t row = open_rows_.from(after(rows_, double{box.least_v}) - 1); row < end;
         row = open_rows_.from(row + 1)) {
      if (row + 1 == rows_.size()) break;
      if (work_ == 0) return false;
      --work_;
      add_to_row(triangle, row);
    }
    return true;
  }

  UvCover cover() const {
    UvCover cover;
    for (std::size_t row = 0; row + 1 < rows_.size(); ++row) {
      for (std::size_t column = 0; column < width_; ++column) {
        const std::uint8_t hits = hits_[row * width_ + column];
        if (hits == 0) continue;
        const double u = columns_[column];
        const double v = rows_[row];
        const double area = (columns_[column + 1] - u) * (rows_[row + 1] - v);
        cover.once += area;
        if (hits > 1) cover.twice += area;
        if (u >= 0 && u < 1 && v >= 0 && v < 1) cover.in_square += area;
      }
    }
    return cover;
  }

 private:
  static std::size_t after(const std::vector<double>& lines, double at) {
    return static_cast<std::size_t>(std::upper_bound(lines.begin(), lines.end(), at) -
                                    lines.begin());
  }

  // Evenly spread places in cells (M. Roberts, "The Unreasonable Effectiveness of Quasirandom
  // Sequences", 2018).
  static double part_of(std::size_t row, double step) {
    const double at = (static_cast<double>(row) + 0.5) * step;
    return at - std::floor(at);
  }

  // The first point of the row that is not left of `u`.
  std::size_t first_point(double u, double part) const {
    const std::size_t next = after(columns_, u);
    if (next == 0) return 0;
    const std::size_t column = next - 1;
    if (column == width_) return width_;
    const double point = columns_[column] + part * (columns_[column + 1] - columns_[column]);
    return point >= u ? column : column + 1;
  }

  void add_to_row(const UvTriangle& triangle, std::size_t row) {
    const double down = part_of(row, 0.7548776662466927);
    const double v = rows_[row] + down * (rows_[row + 1] - rows_[row]);
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
    if (!(least < most)) return;
    const double part = part_of(row, 0.5698402909980532);
    const std::size_t end = row * width_ + first_point(most, part);
    for (std::size_t at = open_points_.from(row * width_ + first_point(least, part)); at < end;
         at = open_points_.from(at + 1)) {
      if (++hits_[at] < 2) continue;
      open_points_.remove(at);
      if (--left_[row] == 0) open_rows_.remove(row);
    }
  }

  const std::vector<double> columns_, rows_;
  const std::size_t width_;
  SkipList open_rows_, open_points_;  // without those that have been hit twice
  std::vector<std::size_t> left_;     // open points, by row
  std::vector<std::uint8_t> hits_;    // by point, up to 2
  std::uint64_t work_ = 0;
};

}  // namespace

std::optional<UvCover> estimate_cover(std::span<const UvTriangle> triangles) {
  if (triangles.empty()) return UvCover();
  CoverGrid grid(triangles);
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    // The third of equal triangles changes nothing.
    const bool again =
        i > 1 && triangles[i] == triangles[i - 1] && triangles[i] == triangles[i - 2];
    if (!again && !grid.add(triangles[i])) return std::nullopt;
  }
  return grid.cover();
}

}  // namespace gltfx::measure
