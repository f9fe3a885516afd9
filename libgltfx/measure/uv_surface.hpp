// SPDX-License-Identifier: Apache-2.0
/// Reads the triangles of materials.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "measure/take.hpp"
#include "measure/uv_plane.hpp"

namespace gltfx::measure {

/// The primitives of each material element that draw triangles; each mesh once.
std::vector<std::vector<MeasuredPrimitive>> primitives_by_material(const Taking& taking);

/// Why there is no surface, or only a part of one.
struct UvProblem {
  std::string text;    ///< a sentence; empty: there is none
  bool fault = false;  ///< coordinates could not be read
};

/// Appends the coordinates of the primitives in set TEXCOORD_n; primitives without it are left out.
UvProblem read_uv_surface(const Source& source, std::span<const MeasuredPrimitive> primitives,
                          std::uint32_t set, model::MemoryBudget& budget, UvSurface& surface);

}  // namespace gltfx::measure
