// SPDX-License-Identifier: Apache-2.0
/// Tangents for assets without them, as the specification's section 3.7.2.1 requires: by the
/// algorithm of MikkTSpace (M. S. Mikkelsen, "Simulation of Wrinkled Surfaces Revisited", 2008,
/// section 6), which bakers of normal maps use, too.
#pragma once

#include "model/geometry.hpp"
#include "model/memory_budget.hpp"

namespace gltfx::model {

/// Fills the tangents of `geometry` for texture coordinates by vertex: those of the normal map, its
/// KHR_texture_transform included.
///
/// Triangles around a vertex share a tangent if they are connected by edges without a seam and
/// without a change between mirrored and plain coordinates; each triangle is weighted by its angle
/// at the vertex. Vertices whose triangles disagree are split, so their number may grow.
/// Coordinates without area give an arbitrary tangent. The handedness is that of glTF, whose
/// texture coordinates run downwards.
///
/// Precondition: there are normals, and as many coordinates as vertices. False, and nothing done,
/// if splitting needs more memory than the budget has.
bool generate_tangents(Geometry& geometry, const Vectors<2>& coordinates, MemoryBudget& budget);

}  // namespace gltfx::model
