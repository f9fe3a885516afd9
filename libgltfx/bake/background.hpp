// SPDX-License-Identifier: Apache-2.0
/// What is seen where nothing of the scene is.
#pragma once

#include "bake/integrator.hpp"

namespace gltfx::bake {

/// Black where it is transparent. `point`: of the picture.
Rgb background(const TraceContext& context, const Vec3d& direction, const Float2& point);

/// What part of the light that falls onto the floor is kept away from it, from 0 to 1 on average.
/// Only what is kept away is estimated: where nothing stands in the way there is no noise. Counts
/// the rays it traces.
double catcher_shadow(const TraceContext& context, const Ray& ray, const Float2& random,
                      std::uint32_t& rays);

}  // namespace gltfx::bake
