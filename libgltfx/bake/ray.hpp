// SPDX-License-Identifier: Apache-2.0
/// Rays and what they hit.
#pragma once

#include <bit>
#include <cstdint>
#include <limits>

#include "bake/scene.hpp"
#include "bake/vector.hpp"

namespace gltfx::bake {

struct Ray {
  Vec3 origin;
  Vec3 direction;  ///< unit length
  float far = std::numeric_limits<float>::infinity();
};

/// A point on a triangle of an instance.
struct Hit {
  float distance = 0;
  std::uint32_t instance = 0;  ///< index in Scene::instances
  std::uint32_t triangle = 0;  ///< index in Mesh::triangles
  float u = 0, v = 0;          ///< weights of the second and third vertex
};

/// A start beside a surface, on the side that `normal` points to, so near that nothing fits
/// between and so far that rounding does not lead back into it (C. Wächter and N. Binder, A Fast
/// and Robust Method for Avoiding Self-Intersection, Ray Tracing Gems 2019). `size`: of the scene,
/// which stands for the metre of the original.
inline Vec3 beside(const Vec3& point, const Vec3& normal, float size) {
  constexpr float kSteps = 256.0F;           // of the last place
  const float near = size * (1.0F / 32.0F);  // around the origin a fixed distance does it
  const float fixed = size * (1.0F / 65536.0F);
  const auto moved = [near, fixed](float p, float n) {
    if (std::fabs(p) < near) return p + fixed * n;
    const auto steps = static_cast<std::int32_t>(kSteps * n);
    return std::bit_cast<float>(std::bit_cast<std::int32_t>(p) + (p < 0 ? -steps : steps));
  };
  return {moved(point.x, normal.x), moved(point.y, normal.y), moved(point.z, normal.z)};
}

}  // namespace gltfx::bake
