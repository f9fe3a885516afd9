// SPDX-License-Identifier: Apache-2.0
/// Normals of triangles whose vertices have none.
#pragma once

#include "prove/soup.hpp"

namespace gltfx::prove {

/// Adds the normals that renderers have to give such triangles: those of their planes. Does nothing
/// without triangles or positions. Precondition: the soup has no normals.
void add_flat_normals(Soup& soup);

}  // namespace gltfx::prove
