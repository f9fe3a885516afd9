// SPDX-License-Identifier: Apache-2.0
/// How far two surfaces are apart.
#pragma once

#include "model/surface_tree.hpp"

namespace gltfx::model {

/// The greatest distance from a point of one surface to the other one.
struct SurfaceDistance {
  double distance = 0;
  Vector3 at{};  ///< the point; of an infinite distance, any
};

/// The greater distance of both directions: from corners and evenly spaced points of the
/// triangles of one surface, more of them on the larger triangles, to the nearest point of the
/// other. Infinite if only one has triangles, or if their triangles are in such a tangle that it
/// would take too long. Stops where it is known to be above `most`: then it is any distance above.
/// Takes about n log n time on up to `jobs` threads, on which the result does not depend.
SurfaceDistance surface_distance(const SurfaceTree& one, const SurfaceTree& other, double most,
                                 unsigned jobs);

}  // namespace gltfx::model
