// SPDX-License-Identifier: Apache-2.0
/// @file
/// Three doubles: a direction or a colour of the shader.
#pragma once

#include <cmath>

namespace gltfx {

/// A direction, or a colour in linear Rec. 709. Products and quotients go component by component.
struct Vec3d {
  double x = 0, y = 0, z = 0;  ///< along the axes; red, green, blue

  constexpr Vec3d() = default;
  /// From three numbers.
  constexpr Vec3d(double x_, double y_, double z_) : x(x_), y(y_), z(z_) {}
  /// Three equal components.
  explicit constexpr Vec3d(double all) : x(all), y(all), z(all) {}

  /// The opposite direction.
  constexpr Vec3d operator-() const { return {-x, -y, -z}; }
  /// Adds component by component.
  constexpr Vec3d& operator+=(const Vec3d& b) { return *this = {x + b.x, y + b.y, z + b.z}; }
  /// Multiplies component by component.
  constexpr Vec3d& operator*=(const Vec3d& b) { return *this = {x * b.x, y * b.y, z * b.z}; }
  /// Multiplies all components.
  constexpr Vec3d& operator*=(double s) { return *this = {x * s, y * s, z * s}; }
  /// Component 0, 1 or 2.
  constexpr double operator[](int i) const { return i == 0 ? x : i == 1 ? y : z; }
  /// Whether all components are equal.
  friend constexpr bool operator==(const Vec3d&, const Vec3d&) = default;
};
/// The same numbers, read as red, green and blue.
using Rgb = Vec3d;

/// Component by component.
constexpr Vec3d operator+(const Vec3d& a, const Vec3d& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
/// Component by component.
constexpr Vec3d operator-(const Vec3d& a, const Vec3d& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
/// Component by component.
constexpr Vec3d operator*(const Vec3d& a, const Vec3d& b) {
  return {a.x * b.x, a.y * b.y, a.z * b.z};
}
/// Component by component.
constexpr Vec3d operator/(const Vec3d& a, const Vec3d& b) {
  return {a.x / b.x, a.y / b.y, a.z / b.z};
}
/// Each component times s.
constexpr Vec3d operator*(const Vec3d& a, double s) { return {a.x * s, a.y * s, a.z * s}; }
/// Each component times s.
constexpr Vec3d operator*(double s, const Vec3d& a) { return a * s; }
/// Each component over s.
constexpr Vec3d operator/(const Vec3d& a, double s) { return {a.x / s, a.y / s, a.z / s}; }

/// Scalar product.
constexpr double dot(const Vec3d& a, const Vec3d& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
/// Vector product.
constexpr Vec3d cross(const Vec3d& a, const Vec3d& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
/// Precondition: not of length 0.
inline Vec3d normalize(const Vec3d& a) { return a * (1 / std::sqrt(dot(a, a))); }
/// The largest component.
constexpr double max_value(const Rgb& a) {
  const double m = a.x > a.y ? a.x : a.y;
  return m > a.z ? m : a.z;
}

}  // namespace gltfx
