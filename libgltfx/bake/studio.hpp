// SPDX-License-Identifier: Apache-2.0
/// Light and backdrop for an object without its own.
#pragma once

#include <gltfx/vec3.hpp>

#include "bake/scene.hpp"

namespace gltfx::bake {

/// Soft boxes around a bright room: a key light from the upper left of a camera that looks along
/// -`backward`, a fill from the right, a rim light from behind. White surfaces come out a little
/// below white.
EnvironmentImage studio_environment(const Vec3d& backward);

/// The unoccluded irradiance of a surface: the integral of the radiance of the environment times
/// the cosine to the normal.
Rgb irradiance(const EnvironmentImage& image, const Vec3d& normal);

/// Radiance of the backdrop at a point of the picture, x and y from 0 to 1 from the upper left.
Rgb backdrop(double x, double y);

}  // namespace gltfx::bake
