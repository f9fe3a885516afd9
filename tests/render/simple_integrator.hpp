// SPDX-License-Identifier: Apache-2.0
/// A path tracer that shares little with that of the library, to test it.
#pragma once

#include "render/integrator.hpp"

namespace gltfx::render {

/// Light along a ray: directions are sampled uniformly but on glass and mirrors, lights other than
/// punctual ones are found by chance only, media are followed collision by collision in one colour,
/// and no path is split or ended early.
Rgb trace_simply(const TraceContext& context, const Ray& ray, const SampleStream& random);

}  // namespace gltfx::render
