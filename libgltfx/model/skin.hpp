// SPDX-License-Identifier: Apache-2.0
/// Skins and the meshes they deform (specification sections 3.7.3 and 3.8).
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "model/mesh.hpp"
#include "model/node.hpp"
#include "model/scene_graph.hpp"

namespace gltfx::model {

/// One skin. Broken indices are empty.
struct Skin {
  json::NodeId object = json::kNoNode;
  json::NodeId inverse_bind_matrices_value = json::kNoNode;  ///< the index in the text
  json::NodeId skeleton_value = json::kNoNode;               ///< likewise
  json::NodeId joints = json::kNoNode;                       ///< array
  std::optional<std::uint32_t> inverse_bind_matrices;
  std::optional<NodeIndex> skeleton;
  std::vector<NodeIndex> joint_nodes;  ///< valid joints, in their order
  std::uint64_t joint_count = 0;       ///< as listed
};

Skin read_skin(const Asset& asset, json::NodeId object);

/// The joints whose common root the Khronos validator finds in the end: it restarts after a joint
/// that has no common root with the previous ones. Empty when that was the last joint.
std::span<const NodeIndex> joints_of_last_root(const std::vector<NodeIndex>& joints,
                                               const SceneGraph& graph);

/// Number of sets of four joints (JOINTS_0, JOINTS_1, ...) of a primitive. 0 when the sets have
/// gaps or do not match WEIGHTS_n, which is reported elsewhere.
std::size_t joint_sets(const Primitive& primitive);

/// The deformations of a mesh.
struct Deformation {
  bool known = false;               ///< the mesh has a list of primitives, all of them objects
  bool has_joints = false;          ///< a primitive binds vertices to joints
  bool names_joints = false;        ///< a primitive has JOINTS_n, also with gaps or without weights
  bool has_rigid = false;           ///< a primitive has no JOINTS_n
  std::uint64_t morph_targets = 0;  ///< of the first primitive; all have the same
  bool targets_are_broken = false;  ///< as in Primitive: their number is unknown
};

/// By index of the mesh. Linear in the meshes.
/// `some_may_lack_targets`: primitives without morph targets may stand beside others, as glTF 2.1
/// has it; otherwise the first primitive decides.
std::vector<Deformation> read_deformations(const std::vector<Mesh>& meshes,
                                           bool some_may_lack_targets = false);

}  // namespace gltfx::model
