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

/// One skin. Indices that lead nowhere are empty.
struct Skin {
  json::NodeId object = json::kNoNode;
  json::NodeId inverse_bind_matrices_value = json::kNoNode;  ///< the index as it stands in the text
  json::NodeId skeleton_value = json::kNoNode;               ///< likewise
  json::NodeId joints = json::kNoNode;                       ///< array
  std::optional<std::uint32_t> inverse_bind_matrices;
  std::optional<NodeIndex> skeleton;
  std::vector<NodeIndex> joint_nodes;  ///< those that lead to a node, in their order
  std::uint64_t joint_count = 0;       ///< as listed
};

Skin read_skin(const Asset& asset, json::NodeId object);

/// The joints whose common root the Khronos validator knows in the end: it begins anew with the
/// joint behind one that has no root in common with those before. Empty when that was the last.
std::span<const NodeIndex> joints_of_last_root(const std::vector<NodeIndex>& joints,
                                               const SceneGraph& graph);

/// How many sets of four joints (JOINTS_0, JOINTS_1, ...) a primitive binds its vertices to. 0 when
/// the sets have gaps or do not pair with WEIGHTS_n: that is reported where it stands.
std::size_t joint_sets(const Primitive& primitive);

/// What may deform a mesh.
struct Deformation {
  bool known = false;               ///< the mesh has a list of primitives, all of them objects
  bool has_joints = false;          ///< a primitive binds vertices to joints
  bool names_joints = false;        ///< a primitive has JOINTS_n, be it in gaps or without weights
  bool has_rigid = false;           ///< a primitive has no JOINTS_n
  std::uint64_t morph_targets = 0;  ///< of the first primitive, which stands for all
  bool targets_are_broken = false;  ///< as in Primitive: nobody knows how many there are
};

/// By index of the mesh. Linear in the meshes.
std::vector<Deformation> read_deformations(const std::vector<Mesh>& meshes);

}  // namespace gltfx::model
