// SPDX-License-Identifier: Apache-2.0
/// Whether a surface is that of a convex body.
#pragma once

#include <cstdint>

#include "measure/surface.hpp"

namespace gltfx::validate {

struct Convexity {
  enum class Kind : std::uint8_t {
    unknown,  ///< without triangles, or with more work than is done
    flat,     ///< all vertices lie in one plane
    dented,   ///< vertices lie on both sides of a triangle
    convex,
  };
  Kind kind = Kind::unknown;
  double depth = 0;             ///< of a dent: how far vertices lie on the wrong side
  double diagonal = 0;          ///< of the bounds
  std::uint64_t inward = 0;     ///< of a convex body: triangles that face its middle
  std::uint64_t triangles = 0;  ///< that have an area
  double origin_outside = 0;    ///< how far the origin lies outside; 0: it does not
};

/// Parts of the diagonal of the bounds: dents up to the first are none, and bodies that are not
/// thicker than the second are flat.
inline constexpr double kDentTolerance = 1e-4, kFlatTolerance = 1e-6;

/// Compares each triangle with the vertices by a tree of boxes: n log n steps for bodies whose
/// triangles are as large as their distances from each other ask for. The work is limited.
Convexity find_convexity(const measure::Surface& surface);

}  // namespace gltfx::validate
