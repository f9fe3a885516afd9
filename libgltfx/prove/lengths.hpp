// SPDX-License-Identifier: Apache-2.0
/// Lengths of materials in the scene.
#pragma once

#include <optional>
#include <vector>

#include "prove/changes.hpp"

namespace gltfx::prove {

/// How much longer lengths in the space of meshes are in the scene, by the material that has them.
class MaterialLengths {
 public:
  explicit MaterialLengths(const Comparison& comparison) : all_(comparison) {}

  /// How far two lengths of a pair of materials are apart in the scene. Nothing: no mesh with the
  /// material has another scale than before, so that they are plain numbers.
  std::optional<double> apart_in_scene(ItemId ours, double here, ItemId theirs, double there);

 private:
  void read();

  const Comparison& all_;
  bool is_read_ = false;
  std::vector<double> here_, there_;  ///< by material, the greatest scale; 0: none
};

}  // namespace gltfx::prove
