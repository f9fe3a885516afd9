// SPDX-License-Identifier: Apache-2.0
/// From the packed numbers of a scene to those that are calculated with.
#pragma once

#include <gltfx/vec3.hpp>

#include <cmath>
#include <cstdint>

#include "bake/scene.hpp"

namespace gltfx::bake {

inline Vec3d to_vec(const Float3& a) { return {a[0], a[1], a[2]}; }
inline Float3 to_float3(const Vec3d& a) {
  return {static_cast<float>(a.x), static_cast<float>(a.y), static_cast<float>(a.z)};
}

/// The next whole number below, of one that fits. (Without SSE4.1 std::floor is a call.)
inline std::int64_t floor_of(double value) {
  const auto whole = static_cast<std::int64_t>(value);
  return whole - (value < static_cast<double>(whole) ? 1 : 0);
}

/// Sine and cosine of an angle from -1 to 1 full turns, to some 1e-9: a third of the time that the
/// library takes for every angle there is.
struct Turn {
  double sine = 0, cosine = 1;
};
inline Turn turn_by(double turns) {
  constexpr double kHalfPi = 1.57079632679489662;
  const std::int64_t quarters = floor_of(turns * 4 + 0.5);
  const double x = (turns * 4 - static_cast<double>(quarters)) * kHalfPi;
  const double q = x * x;
  const double s =
      x * (1 + q * (-1.0 / 6 + q * (1.0 / 120 + q * (-1.0 / 5040 + q * (1.0 / 362880)))));
  const double c =
      1 + q * (-0.5 + q * (1.0 / 24 + q * (-1.0 / 720 + q * (1.0 / 40320 - q * (1.0 / 3628800)))));
  switch (quarters & 3) {
    case 0:
      return {s, c};
    case 1:
      return {c, -s};
    case 2:
      return {-s, -c};
    default:
      return {-c, s};
  }
}

inline double length(const Vec3d& a) { return std::sqrt(dot(a, a)); }
/// Relative luminance of linear Rec. 709.
constexpr double luminance(const Rgb& c) { return 0.2126 * c.x + 0.7152 * c.y + 0.0722 * c.z; }

inline Vec3d transform_vector(const Matrix34& m, const Vec3d& v) {
  return {m[0][0] * v.x + m[0][1] * v.y + m[0][2] * v.z,
          m[1][0] * v.x + m[1][1] * v.y + m[1][2] * v.z,
          m[2][0] * v.x + m[2][1] * v.y + m[2][2] * v.z};
}

inline Vec3d transform_point(const Matrix34& m, const Vec3d& p) {
  return transform_vector(m, p) + Vec3d(m[0][3], m[1][3], m[2][3]);
}

/// A normal, by the cofactors of the linear part: right for scales that differ by axis, for mirrors
/// and for flattened objects. Not of unit length.
inline Vec3d transform_normal(const Matrix34& m, const Vec3d& n) {
  const Vec3d x(m[0][0], m[1][0], m[2][0]);
  const Vec3d y(m[0][1], m[1][1], m[2][1]);
  const Vec3d z(m[0][2], m[1][2], m[2][2]);
  return cross(y, z) * n.x + cross(z, x) * n.y + cross(x, y) * n.z;
}

inline double determinant(const Matrix34& m) {
  return dot(Vec3d(m[0][0], m[1][0], m[2][0]),
             cross(Vec3d(m[0][1], m[1][1], m[2][1]), Vec3d(m[0][2], m[1][2], m[2][2])));
}

}  // namespace gltfx::bake
