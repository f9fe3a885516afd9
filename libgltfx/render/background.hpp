// SPDX-License-Identifier: Apache-2.0
/// The background of a picture, and the shadow on it.
#pragma once

#include "render/integrator.hpp"

namespace gltfx::render {

/// Hermite's cubic from 0 at `from` to 1 at `to`, constant beyond.
double smooth_step(double from, double to, double x);

/// Black if the background is transparent. `point`: of the picture.
Rgb background(const TraceContext& context, const Vec3d& direction, const Float2& point);

/// The part of the light on the shadow catcher that the scene occludes, from 0 to 1 on average.
/// Only occluded light is estimated, so that an unoccluded point has no noise. Counts its rays.
double catcher_shadow(const TraceContext& context, const Ray& ray, const Float2& random,
                      std::uint32_t& rays);

}  // namespace gltfx::render
