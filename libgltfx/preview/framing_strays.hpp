// SPDX-License-Identifier: Apache-2.0
/// Outliers among triangles, which framing ignores.
#pragma once

#include "preview/framing.hpp"

namespace gltfx::preview {

/// Removes triangles with a corner far outside of the range of 99 % of the corners along an axis,
/// and small separate parts: of less than an eighth of the size of the part with the most area,
/// further from it than a quarter of its size, and all together of less than a hundredth of its
/// area.
void drop_strays(Subject& subject);

}  // namespace gltfx::preview
