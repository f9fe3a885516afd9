// SPDX-License-Identifier: Apache-2.0
/// Next event estimation: direct light at a vertex of a path.
#pragma once

#include <algorithm>

#include "render/integrator.hpp"
#include "render/path.hpp"
#include "render/surface.hpp"
#include "shader/material.hpp"

namespace gltfx::render {

/// The environment counts once along a path: through the first wall that lets it in, and not again
/// when that wall reflects it.
inline bool sees_environment(const TraceContext& context, const PathState& path) {
  return context.world.environment && !path.prefix.environment_in;
}

/// The share of `part` in all light, by colour; from 0 to 1.
inline Rgb share_of(const Rgb& part, const Rgb& all) {
  const auto ratio = [](double a, double b) { return b > 0 ? std::clamp(a / b, 0.0, 1.0) : 0.0; };
  return {ratio(part.x, all.x), ratio(part.y, all.y), ratio(part.z, all.z)};
}

/// Adds the light at a surface. The first one of a path gets more samples, because its light is the
/// most visible. The sky chooses among many directions itself; emitters are resampled from some
/// candidates. Sets `path.sky_pdf`.
void add_direct_light(const TraceContext& context, PathState& path, const Hit& hit,
                      const Surface& surface, const shader::Bsdf& bsdf, PathSample& L);

/// Adds the light of lamps at the start of the next ray, in a medium.
void add_direct_light(const TraceContext& context, const PathState& path, PathSample& L);

}  // namespace gltfx::render
