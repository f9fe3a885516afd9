// SPDX-License-Identifier: Apache-2.0
/// Triangles that a picture of the rest is not to make room for.
#pragma once

#include "bake/framing.hpp"

namespace gltfx::bake {

/// Leaves out triangles with a corner far outside of where all but a hundredth of the corners are
/// along an axis, and small parts that lie apart: of less than an eighth of the size and together
/// not a hundredth of the area of the part with the most area, and further from it than a quarter
/// of its size.
void drop_strays(Subject& subject);

}  // namespace gltfx::bake
