// SPDX-License-Identifier: Apache-2.0
/// Tangents where an asset gives none, as the specification's section 3.7.2.1 asks for them: by the
/// algorithm of MikkTSpace (M. S. Mikkelsen, "Simulation of Wrinkled Surfaces Revisited", 2008,
/// section 6), whose tangent spaces bakers of normal maps use, too.
#pragma once

#include "model/geometry.hpp"
#include "model/memory_budget.hpp"

namespace gltfx::model {

/// Fills the tangents of `geometry` for texture coordinates by vertex: those that the normal map is
/// read with, its KHR_texture_transform included.
///
/// Triangles around a vertex share a tangent as far as one gets from one to the other over edges
/// without a seam and without a change between mirrored and plain coordinates; what a triangle adds
/// counts by its angle at the vertex. Vertices whose triangles disagree are split, so that there
/// may be more of them afterwards. Coordinates that have no area give any tangent. The handedness
/// is that of glTF, whose texture coordinates run downwards.
///
/// Precondition: there are normals, and as many coordinates as vertices. False, and nothing done,
/// where splitting asks for more memory than there is in the budget.
bool generate_tangents(Geometry& geometry, const Vectors<2>& coordinates, MemoryBudget& budget);

}  // namespace gltfx::model
