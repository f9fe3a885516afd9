// SPDX-License-Identifier: Apache-2.0
#include "model/longest_axis.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace gltfx::model {

// The greatest eigenvalue of the transform times its transpose, in closed form (O. Smith,
// Eigenvalues of a symmetric 3 x 3 matrix, 1961).
double longest_axis(const Affine& transform) {
  const Vector3& x = transform.columns[0];
  const Vector3& y = transform.columns[1];
  const Vector3& z = transform.columns[2];
  const double xx = dot(x, x), yy = dot(y, y), zz = dot(z, z);
  const double xy = dot(x, y), xz = dot(x, z), yz = dot(y, z);
  const double mean = (xx + yy + zz) / 3;
  if (xy == 0 && xz == 0 && yz == 0) return std::sqrt(std::max({xx, yy, zz}));
  const double a = xx - mean, b = yy - mean, c = zz - mean;
  const double spread = std::sqrt((a * a + b * b + c * c + 2 * (xy * xy + xz * xz + yz * yz)) / 6);
  if (!(spread > 0)) return std::sqrt(mean);
  const double determinant =
      a * (b * c - yz * yz) - xy * (xy * c - yz * xz) + xz * (xy * yz - b * xz);
  const double part = std::clamp(determinant / (2 * spread * spread * spread), -1.0, 1.0);
  return std::sqrt(mean + 2 * spread * std::cos(std::acos(part) / 3));
}

}  // namespace gltfx::model
