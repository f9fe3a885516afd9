// SPDX-License-Identifier: Apache-2.0
/// Three numbers: a point, a direction or a colour.
#pragma once

#include <algorithm>
#include <cmath>

namespace gltfx::bake {

inline constexpr float kPi = 3.14159265358979F;

struct Vec3 {
  float x = 0, y = 0, z = 0;

  constexpr Vec3() = default;
  constexpr Vec3(float x_, float y_, float z_) : x(x_), y(y_), z(z_) {}
  explicit constexpr Vec3(float all) : x(all), y(all), z(all) {}

  constexpr Vec3 operator-() const { return {-x, -y, -z}; }
  constexpr Vec3& operator+=(const Vec3& b) { return *this = {x + b.x, y + b.y, z + b.z}; }
  constexpr Vec3& operator*=(const Vec3& b) { return *this = {x * b.x, y * b.y, z * b.z}; }
  constexpr Vec3& operator*=(float s) { return *this = {x * s, y * s, z * s}; }
  friend constexpr bool operator==(const Vec3&, const Vec3&) = default;
};

constexpr Vec3 operator+(const Vec3& a, const Vec3& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
constexpr Vec3 operator-(const Vec3& a, const Vec3& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
constexpr Vec3 operator*(const Vec3& a, const Vec3& b) { return {a.x * b.x, a.y * b.y, a.z * b.z}; }
constexpr Vec3 operator/(const Vec3& a, const Vec3& b) { return {a.x / b.x, a.y / b.y, a.z / b.z}; }
constexpr Vec3 operator*(const Vec3& a, float s) { return {a.x * s, a.y * s, a.z * s}; }
constexpr Vec3 operator*(float s, const Vec3& a) { return a * s; }
constexpr Vec3 operator/(const Vec3& a, float s) { return a * (1.0F / s); }

constexpr float dot(const Vec3& a, const Vec3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
constexpr Vec3 cross(const Vec3& a, const Vec3& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline float length(const Vec3& a) { return std::sqrt(dot(a, a)); }
/// Precondition: not of length 0.
inline Vec3 normalize(const Vec3& a) { return a / length(a); }
constexpr float max_component(const Vec3& a) { return std::max({a.x, a.y, a.z}); }
/// Relative luminance of linear Rec. 709.
constexpr float luminance(const Vec3& a) { return 0.2126F * a.x + 0.7152F * a.y + 0.0722F * a.z; }

}  // namespace gltfx::bake
