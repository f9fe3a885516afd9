// SPDX-License-Identifier: Apache-2.0
/// The area that triangles cover which may lie on each other.
#pragma once

#include <optional>
#include <span>

#include "measure/uv_plane.hpp"

namespace gltfx::measure {

/// Areas in the plane of texture coordinates.
struct UvCover {
  double once = 0;       ///< that a triangle covers
  double twice = 0;      ///< that two or more cover
  double in_square = 0;  ///< that one covers in the square from 0 to 1
};

/// Estimated with about 65,536 points in a grid whose lines are closer where there are more
/// corners: small islands that are far apart count as large ones do. Nothing: out of a budget of
/// work that is linear in the triangles, all of which have an area.
std::optional<UvCover> estimate_cover(std::span<const UvTriangle> triangles);

}  // namespace gltfx::measure
