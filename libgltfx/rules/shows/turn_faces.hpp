// SPDX-License-Identifier: Apache-2.0
/// Fixes of surfaces on the wrong side: of plain numbers in buffers that nothing else uses.
#pragma once

#include "rules/fix.hpp"

namespace gltfx::validate {

/// Reverses the triangles of a primitive, or its normals: what the finding marks.
bool turn_wrong_one(Fixing& fixing, const Subject& subject);
/// Reverses triangles and normals of a primitive or of all primitives of a mesh.
bool turn_inside_out(Fixing& fixing, const Subject& subject);

}  // namespace gltfx::validate
