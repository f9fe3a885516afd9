// SPDX-License-Identifier: Apache-2.0
/// Light and backdrop for an object that brings none.
#pragma once

#include <gltfx/vec3.hpp>

#include "bake/scene.hpp"

namespace gltfx::bake {

/// Soft boxes around a bright room: a key light from the upper left of whoever looks along
/// -`backward`, a fill from the right, a rim light from behind. White surfaces come out a little
/// below white.
EnvironmentImage studio_environment(const Vec3d& backward);

/// What an environment gives to a surface with that normal and nothing in the way: the integral of
/// its radiance times the cosine.
Rgb irradiance(const EnvironmentImage& image, const Vec3d& normal);

/// Radiance of the backdrop at a point of the picture, x and y from 0 to 1 from the upper left.
Rgb backdrop(double x, double y);

}  // namespace gltfx::bake
