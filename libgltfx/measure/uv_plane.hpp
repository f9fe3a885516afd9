// SPDX-License-Identifier: Apache-2.0
/// Triangles in the plane of texture coordinates: unwrapped, v points down.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "model/elements.hpp"
#include "model/geometry.hpp"

namespace gltfx::measure {

using UvPoint = std::array<float, 2>;
using UvTriangle = std::array<UvPoint, 3>;

/// The unwrapped triangles of one material. Any coordinates, also those that are not finite.
struct UvSurface {
  model::Vectors<2> points;
  std::vector<model::Triangle> triangles;  ///< indices of points

  UvTriangle corners(std::size_t triangle) const {
    const auto& [a, b, c] = triangles[triangle];
    return {points[a], points[b], points[c]};
  }
};

/// Distances that do not matter: the step of coordinates in 16 bits, the coarsest that are common.
inline constexpr double kUvNoise = 1.0 / 65536;

/// Rectangle with edges along the axes; touching rectangles do not overlap.
struct UvBox {
  float least_u = INFINITY, least_v = INFINITY, most_u = -INFINITY, most_v = -INFINITY;

  void include(const UvPoint& at) {
    least_u = std::min(least_u, at[0]);
    least_v = std::min(least_v, at[1]);
    most_u = std::max(most_u, at[0]);
    most_v = std::max(most_v, at[1]);
  }
  void include(const UvBox& other) {
    include(UvPoint{other.least_u, other.least_v});
    include(UvPoint{other.most_u, other.most_v});
  }
  bool overlaps(const UvBox& other) const {
    // All comparisons without branches, which could not be predicted.
    const unsigned u = unsigned{least_u < other.most_u} & unsigned{other.least_u < most_u};
    const unsigned v = unsigned{least_v < other.most_v} & unsigned{other.least_v < most_v};
    return (u & v) != 0;
  }
};

inline UvBox box_of(const UvTriangle& triangle) {
  UvBox box;
  for (const UvPoint& corner : triangle) box.include(corner);
  return box;
}

/// Twice the area from `a` to `b` and `c`; positive if they run clockwise, seen with v down.
inline double turn(const UvPoint& a, const UvPoint& b, const UvPoint& c) {
  const auto d = [](float from, float to) { return double{to} - double{from}; };
  return d(a[0], b[0]) * d(a[1], c[1]) - d(a[0], c[0]) * d(a[1], b[1]);
}

/// Positive if the triangle is mirrored.
inline double signed_area(const UvTriangle& t) { return turn(t[0], t[1], t[2]) / 2; }

inline bool is_finite(const UvTriangle& triangle) {
  return std::all_of(triangle.begin(), triangle.end(), [](const UvPoint& at) {
    return std::isfinite(at[0]) && std::isfinite(at[1]);
  });
}

/// Whether the corners are on one line, within the precision of the numbers. Precondition:
/// is_finite().
inline bool is_degenerate(const UvTriangle& triangle) {
  constexpr double kPrecision = 1.0 / (1U << 22U);
  const auto square = [](double number) { return number * number; };
  double largest = 0;  // squares
  double longest = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto [u, v] = triangle[i];
    const auto [next_u, next_v] = triangle[(i + 1) % 3];
    largest = std::max({largest, square(double{u}), square(double{v})});
    longest =
        std::max(longest, square(double{next_u} - double{u}) + square(double{next_v} - double{v}));
  }
  return square(2 * signed_area(triangle)) <= longest * largest * square(kPrecision);
}

}  // namespace gltfx::measure
