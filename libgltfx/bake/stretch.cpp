// SPDX-License-Identifier: Apache-2.0
#include "bake/stretch.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "bake/storage.hpp"

namespace gltfx::bake {

double inverse_norm(const Matrix34& m) {
  constexpr double kMost = 1e9;
  const double volume = determinant(m);
  const Vec3d x(m[0][0], m[1][0], m[2][0]);
  const Vec3d y(m[0][1], m[1][1], m[2][1]);
  const Vec3d z(m[0][2], m[1][2], m[2][2]);
  const Vec3d place(m[0][3], m[1][3], m[2][3]);
  double most = 0;
  for (const Vec3d& row : {cross(y, z), cross(z, x), cross(x, y)}) {
    const double sum = (std::fabs(row.x) + std::fabs(row.y) + std::fabs(row.z)) / std::fabs(volume);
    const bool fits = sum < kMost && std::fabs(dot(row, place) / volume) < kFarthest;
    most = std::max(most, fits ? sum : std::numeric_limits<double>::infinity());
  }
  return most;
}

}  // namespace gltfx::bake
