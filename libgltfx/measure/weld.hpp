// SPDX-License-Identifier: Apache-2.0
/// Vertices at the same place become one.
#pragma once

#include <vector>

#include "base/packed.hpp"
#include "model/geometry.hpp"

namespace gltfx::measure {

/// Replaces `positions` by the distinct ones that triangles use, in the order of their first use,
/// and renumbers the triangles. Positions are the same if their numbers are equal, or if they are
/// no farther apart than `distance`, directly or over others between them. Triangles with a
/// position that is not finite are left out. n log n steps for any positions. False, and the
/// content of both is unspecified: so many vertices are within `distance` of others that the search
/// takes too long. Precondition: each index is that of a position.
bool weld(std::vector<Float3>& positions, std::vector<model::Triangle>& triangles, double distance);

}  // namespace gltfx::measure
