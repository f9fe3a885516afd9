// SPDX-License-Identifier: Apache-2.0
/// Transforms of nodes: translation, rotation, scale, and matrices of them (specification section
/// 3.5.3).
#pragma once

#include <array>

namespace gltfx::model {

using Vector3 = std::array<double, 3>;
/// x, y, z, w, as glTF writes rotations.
using Quaternion = std::array<double, 4>;

/// A matrix of three rows: what glTF's transforms are, whose fourth row is always 0 0 0 1. Double
/// precision, so that long chains of parents add no error that could be seen.
struct Affine {
  /// The columns x, y, z of the linear part, then the translation.
  std::array<Vector3, 4> columns{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 0, 0}}};

  /// Of a column-major 4 x 4 matrix; its last row is not looked at.
  static Affine from_matrix(const std::array<float, 16>& matrix);
  /// Scale first, then rotation, then translation. The rotation need not be of unit length; one of
  /// length zero turns nothing.
  static Affine from_parts(const Vector3& translation, const Quaternion& rotation,
                           const Vector3& scale);

  Vector3 point(const Vector3& at) const;
  Vector3 vector(const Vector3& along) const;
  /// Of the linear part: negative where the transform mirrors.
  double determinant() const;
  bool operator==(const Affine&) const = default;
};

/// `inner` first, then `outer`.
Affine operator*(const Affine& outer, const Affine& inner);

double dot(const Vector3& a, const Vector3& b);
Vector3 cross(const Vector3& a, const Vector3& b);
/// In the direction of `a` with length 1; zero where it has none.
Vector3 unit(const Vector3& a);

/// Between two rotations along the shorter arc, for `t` from 0 to 1; of unit length.
Quaternion slerp(const Quaternion& from, const Quaternion& to, double t);
/// Of unit length; the identity where there is no direction.
Quaternion unit(const Quaternion& q);

}  // namespace gltfx::model
