// SPDX-License-Identifier: Apache-2.0
/// Rays and their hits.
#pragma once

#include <gltfx/vec3.hpp>

#include <cmath>
#include <cstdint>
#include <limits>

#include "base/bit_cast.hpp"
#include "render/scene.hpp"

namespace gltfx::render {

struct Ray {
  Vec3d origin;
  Vec3d direction;  ///< unit length
  double far = std::numeric_limits<double>::infinity();
};

/// A point on a triangle of an instance.
struct Hit {
  double distance = 0;
  std::uint32_t instance = 0;  ///< index in Scene::instances
  std::uint32_t mesh = 0;      ///< index in Scene::meshes
  std::uint32_t triangle = 0;  ///< index in Mesh::triangles
  float u = 0, v = 0;          ///< weights of the second and third vertex

  /// A number of this mesh in this instance.
  std::uint64_t body() const { return std::uint64_t{instance} << 32U | mesh; }
};

/// The start of a ray beside a surface, on the side of `normal`, at a distance at which rounding
/// cannot cross the surface (C. Wächter and N. Binder, A Fast and Robust Method for Avoiding
/// Self-Intersection, Ray Tracing Gems 2019). `size`: of the scene, in place of the metre of the
/// paper.
inline Vec3d beside(const Vec3d& point, const Vec3d& normal, double size) {
  constexpr double kSteps = 256;      // of the last place of a float, in which rays are traced
  const double near = size * 0x1p-5;  // around the origin a fixed distance is enough
  const double fixed = size * 0x1p-16;
  const auto moved = [near, fixed](double p, double n) {
    if (std::fabs(p) < near) return p + fixed * n;
    const auto steps = static_cast<std::int32_t>(kSteps * n);
    const auto bits = bit_cast<std::int32_t>(static_cast<float>(p));
    return static_cast<double>(bit_cast<float>(bits + (p < 0 ? -steps : steps)));
  };
  return {moved(point.x, normal.x), moved(point.y, normal.y), moved(point.z, normal.z)};
}

}  // namespace gltfx::render
