// SPDX-License-Identifier: Apache-2.0
/// Transforms and visibility of the nodes of a scene (specification section 3.5).
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "model/node.hpp"
#include "model/properties.hpp"
#include "model/resource_data.hpp"
#include "model/views.hpp"

namespace gltfx::model {

/// The roots that are drawn.
struct SceneRoots {
  std::vector<NodeIndex> nodes;
  std::string note;  ///< how it was chosen if the file does not say, one sentence; else empty
  std::optional<std::uint32_t> scene = {};  ///< absent: the file has none
};

/// The roots of scene `wanted`; else of the default scene, else of the first one, else all nodes
/// that have no parent.
SceneRoots choose_scene(const Asset& asset, const Views& views,
                        std::optional<std::uint32_t> wanted = std::nullopt);

/// All nodes at one moment.
struct Pose {
  std::vector<Affine> world;           ///< by node, also of those outside of any scene
  std::vector<std::uint8_t> in_scene;  ///< by node: reached from the roots
  std::vector<std::uint8_t> visible;   ///< likewise, and neither it nor a parent is hidden
};

/// Linear in the nodes, also for a chain of a million; a node that is reached twice counts where it
/// is reached first. Nodes outside the scene are placed by their own parents: they may be joints.
Pose compute_pose(const Asset& asset, const Views& views, const SceneRoots& roots,
                  const AnimatedValues& animated = {});

/// The transform of a node relative to its parent, as it is stored.
Affine stored_transform(const Asset& asset, const Node& node);

/// The weights of the morph targets of a node with a mesh: its own or those of the mesh.
std::vector<float> morph_weights(const Asset& asset, const Views& views, NodeIndex node,
                                 const AnimatedValues& animated = {});

/// From the space of a skinned mesh to that of the scene, by joint. Empty when a joint index is
/// broken.
std::vector<Affine> joint_matrices(const Asset& asset, const Views& views,
                                   const ResourceData& resources, std::uint32_t skin,
                                   const Pose& pose);

}  // namespace gltfx::model
