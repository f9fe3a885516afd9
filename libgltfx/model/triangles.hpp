// SPDX-License-Identifier: Apache-2.0
/// Triangles from the indices of a primitive, in any of the modes that have some (specification
/// section 3.7.2.1).
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "model/mesh.hpp"

namespace gltfx::model {

using Triangle = std::array<std::uint32_t, 3>;

/// Whether a mode draws triangles.
bool draws_triangles(Mode mode);

/// Takes indices one after the other and makes triangles of them. Those that do not exist, and
/// triangles that have one vertex twice and so no area, are left out; an odd one in a strip keeps
/// its front in front.
class TriangleAssembly {
 public:
  /// `vertices`: how many there are. An index equal to `restart` begins a new strip or fan
  /// (EXT_mesh_primitive_restart); in files without that extension there is none.
  TriangleAssembly(Mode mode, std::uint32_t vertices, std::uint32_t restart,
                   std::vector<Triangle>& to)
      : mode_(mode), vertices_(vertices), restart_(restart), triangles_(to) {}

  void add(std::uint32_t index);

 private:
  void emit(std::uint32_t a, std::uint32_t b, std::uint32_t c);

  Mode mode_;
  std::uint32_t vertices_;
  std::uint32_t restart_;
  std::vector<Triangle>& triangles_;
  std::uint64_t count_ = 0;  ///< indices since the beginning or the last restart
  std::array<std::uint32_t, 2> held_{};
};

}  // namespace gltfx::model
