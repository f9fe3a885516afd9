// SPDX-License-Identifier: Apache-2.0
/// One path, from what a ray of the camera hits.
#pragma once

#include <cstdint>
#include <optional>

#include "bake/integrator.hpp"

namespace gltfx::bake {

/// One of several paths with the same beginning.
struct Branch {
  std::uint32_t number = 0, count = 1;
  Branch part(std::uint32_t i, std::uint32_t parts) const {
    return {number * parts + i, count * parts};
  }
};

struct PathStart {
  std::optional<Hit> hit;   ///< nothing: beyond the scene
  std::uint32_t layer = 0;  ///< of paths along one ray; each draws numbers of its own
  Branch branch;
};

/// As trace_path(), without layers of alpha.
PathSample follow_path(const PathSetting& setting, const Ray& ray, const Float2& point,
                       const SampleStream& random, const PathStart& start);
/// As look_along(), likewise.
PathSample look_at_start(const PathSetting& setting, const Ray& ray, const Float2& point,
                         const SampleStream& random, const PathStart& start);

}  // namespace gltfx::bake
