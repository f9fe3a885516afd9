// SPDX-License-Identifier: Apache-2.0
/// What the default scene draws, and where: primitives with their bounds in the scene. No vertex is
/// read.
#pragma once

#include <cstdint>
#include <vector>

#include "model/pose.hpp"
#include "rules/payload/phases.hpp"

namespace gltfx::validate {

/// A primitive that a node draws once, at rest.
struct Placed {
  model::NodeIndex node = 0;
  std::uint32_t mesh = 0;
  std::uint32_t primitive = 0;
  BoundsBox box;  ///< in the scene
};

class PlacedScene {
 public:
  /// Linear in nodes and what they draw, up to a limit beyond which the scene is not complete.
  explicit PlacedScene(DataPhase& phase);

  const model::Pose& pose() const { return pose_; }
  /// Without what is skinned, drawn as instances, or hidden.
  const std::vector<Placed>& parts() const { return parts_; }
  /// Whether parts() are all that the scene draws.
  bool complete() const { return complete_; }
  /// Whether it draws external assets, which are not among parts().
  bool has_external_assets() const { return external_; }
  /// Whether an animation may move the node or one above it.
  bool moves(model::NodeIndex node) const { return moves_all_ || moves_[node] != 0; }
  /// Whether an animation may move any node.
  bool moves() const { return moves_any_; }

  bool draws(std::uint32_t mesh) const { return meshes_[mesh] != 0; }
  bool skins(std::uint32_t mesh) const { return meshes_[mesh] == kSkinned; }

 private:
  static constexpr std::uint8_t kDrawn = 1, kSkinned = 2;

  void find_moving();
  void place(model::NodeIndex index);

  DataPhase& phase_;
  const Context& context_;
  const model::Pose& pose_;
  std::vector<Placed> parts_;
  std::vector<std::uint8_t> meshes_;  ///< by mesh: 0, kDrawn or kSkinned
  std::vector<std::uint8_t> moves_;   ///< by node
  bool moves_all_ = false;
  bool moves_any_ = false;
  bool complete_ = true;
  bool external_ = false;
};

/// Whether a box has numbers and is not empty.
inline bool is_sound(const BoundsBox& box) { return box.width() >= 0 && box.width() < 1e30; }

}  // namespace gltfx::validate
