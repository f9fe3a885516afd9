// SPDX-License-Identifier: Apache-2.0
/// How normals and textures of a surface move when it is simplified.
#pragma once

#include "model/surface_tree.hpp"
#include "steps/simplify_search.hpp"

namespace gltfx::steps {

/// Compares values at the centers of the old triangles with those of the new surface within
/// `radius`, in the unit of positions; the nearest value counts, so that both sides of a seam or
/// crease are looked at. The slide is in the unit of the error of the job.
SimplifyDrift measure_drift(const SimplifyJob& job, const model::SurfaceTree& after, double radius,
                            unsigned jobs);

}  // namespace gltfx::steps
