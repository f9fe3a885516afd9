// SPDX-License-Identifier: Apache-2.0
#include "model/scene_diagonal.hpp"

#include <cmath>

#include "model/scene_box.hpp"
#include "model/scene_extent.hpp"

namespace gltfx::model {

double scene_diagonal(const GeometrySource& source, const Pose& pose) {
  if (const auto box = scene_box(source, pose)) return box->diagonal();
  constexpr std::uint64_t kInstanceBytes = std::uint64_t{1} << 28U;
  const auto bounds =
      scene_extent(source.asset, source.views, source.resources, {}, kInstanceBytes, pose).bounds;
  if (!bounds) return 0;
  const auto& [least, greatest] = *bounds;
  return std::hypot(greatest[0] - least[0], greatest[1] - least[1], greatest[2] - least[2]);
}

}  // namespace gltfx::model
