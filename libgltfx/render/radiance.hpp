// SPDX-License-Identifier: Apache-2.0
/// Light along a path.
#pragma once

#include <optional>

#include "render/feature_recorder.hpp"
#include "render/path.hpp"

namespace gltfx::render {

/// Radiance that arrives along the ray of a path, by unidirectional path tracing, with next event
/// estimation, multiple importance sampling, splitting at the first surface, and Russian roulette.
/// `path` and `features` are consumed. `hit`: of the camera ray; those of later rays are found
/// here. `point`: of the picture, for the backdrop.
PathSample incident_radiance(const TraceContext& context, PathState& path,
                             FeatureRecorder& features, std::optional<Hit> hit,
                             const Float2& point);

}  // namespace gltfx::render
