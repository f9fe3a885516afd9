// SPDX-License-Identifier: Apache-2.0
/// Smooth boundaries and what light does between them.
#pragma once

#include <gltfx/material.hpp>

namespace gltfx::ground_truth {

/// The effect of a smooth boundary on a ray that comes from v.
struct Crossing {
  Rgb reflected, transmitted;
  Vec3d onwards;  ///< direction behind the boundary; z is 0 when there is none
};
Crossing cross_boundary(const Material& material, const Vec3d& v);

/// Radiance of a smooth sphere in an environment of radiance 1, seen under v at the point where the
/// ray enters.
Rgb sphere_radiance(const Material& material, double radius, const Vec3d& v);

}  // namespace gltfx::ground_truth
