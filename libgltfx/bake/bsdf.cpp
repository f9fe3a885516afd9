// SPDX-License-Identifier: Apache-2.0
#include "bake/bsdf.hpp"

namespace gltfx::bake {

CoatFrame::CoatFrame(const Vec3d& normal) {
  if (normal == Vec3d(0, 0, 1)) return;
  z = normal;
  const Vec3d along = Vec3d(1, 0, 0) - normal.x * normal;
  const Vec3d other = std::fabs(normal.x) < 0.99 ? along : Vec3d(0, 1, 0) - normal.y * normal;
  x = normalize(other);
  y = cross(z, x);
}

}  // namespace gltfx::bake
