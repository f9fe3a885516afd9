// SPDX-License-Identifier: Apache-2.0
/// From the packed numbers of a scene to those that are calculated with.
#pragma once

#include "bake/scene.hpp"
#include "bake/vector.hpp"

namespace gltfx::bake {

inline Vec3 to_vec(const Float3& a) { return {a[0], a[1], a[2]}; }
inline Float3 to_float3(const Vec3& a) { return {a.x, a.y, a.z}; }

inline Vec3 transform_vector(const Matrix34& m, const Vec3& v) {
  return {m[0][0] * v.x + m[0][1] * v.y + m[0][2] * v.z,
          m[1][0] * v.x + m[1][1] * v.y + m[1][2] * v.z,
          m[2][0] * v.x + m[2][1] * v.y + m[2][2] * v.z};
}

inline Vec3 transform_point(const Matrix34& m, const Vec3& p) {
  return transform_vector(m, p) + Vec3(m[0][3], m[1][3], m[2][3]);
}

/// A normal, by the cofactors of the linear part: right for scales that differ by axis, for mirrors
/// and for flattened objects. Not of unit length.
inline Vec3 transform_normal(const Matrix34& m, const Vec3& n) {
  const Vec3 x(m[0][0], m[1][0], m[2][0]);
  const Vec3 y(m[0][1], m[1][1], m[2][1]);
  const Vec3 z(m[0][2], m[1][2], m[2][2]);
  return cross(y, z) * n.x + cross(z, x) * n.y + cross(x, y) * n.z;
}

inline float determinant(const Matrix34& m) {
  return dot(Vec3(m[0][0], m[1][0], m[2][0]),
             cross(Vec3(m[0][1], m[1][1], m[2][1]), Vec3(m[0][2], m[1][2], m[2][2])));
}

}  // namespace gltfx::bake
