// SPDX-License-Identifier: Apache-2.0
/// Affine transforms of points, vectors and normals.
#pragma once

#include <gltfx/vec3.hpp>

#include "render/scene.hpp"

namespace gltfx::render {

inline Vec3d transform_vector(const Matrix34& m, const Vec3d& v) {
  return {m[0][0] * v.x + m[0][1] * v.y + m[0][2] * v.z,
          m[1][0] * v.x + m[1][1] * v.y + m[1][2] * v.z,
          m[2][0] * v.x + m[2][1] * v.y + m[2][2] * v.z};
}

inline Vec3d transform_point(const Matrix34& m, const Vec3d& p) {
  return transform_vector(m, p) + Vec3d(m[0][3], m[1][3], m[2][3]);
}

inline double determinant(const Matrix34& m) {
  return dot(Vec3d(m[0][0], m[1][0], m[2][0]),
             cross(Vec3d(m[0][1], m[1][1], m[2][1]), Vec3d(m[0][2], m[1][2], m[2][2])));
}

/// The transform of normals by the cofactors of the linear part: correct for non-uniform scales,
/// mirrors and flattened objects. Results are not of unit length.
class NormalTransform {
 public:
  explicit NormalTransform(const Matrix34& m) {
    const Vec3d x(m[0][0], m[1][0], m[2][0]);
    const Vec3d y(m[0][1], m[1][1], m[2][1]);
    const Vec3d z(m[0][2], m[1][2], m[2][2]);
    x_ = cross(y, z);
    y_ = cross(z, x);
    z_ = cross(x, y);
    if (dot(x, x_) < 0) handedness_ = -1;
  }
  /// On the front side of a triangle, mirrored or not.
  Vec3d outward(const Vec3d& n) const { return (x_ * n.x + y_ * n.y + z_ * n.z) * handedness_; }
  double handedness() const { return handedness_; }

 private:
  Vec3d x_, y_, z_;
  double handedness_ = 1;
};

}  // namespace gltfx::render
