// SPDX-License-Identifier: Apache-2.0
/// Where meshes are drawn, and how their places take up another lattice of coordinates.
#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "json/edit.hpp"
#include "model/pose.hpp"
#include "model/scene_graph.hpp"
#include "steps/attribute_roles.hpp"
#include "steps/instance_places.hpp"
#include "steps/quantize_values.hpp"
#include "steps/step_data.hpp"

namespace gltfx::steps {

/// How the nodes of a mesh take up its grid.
enum class Carrier : std::uint8_t {
  transform,  ///< the node moves only its mesh: its transform changes
  child,      ///< a new child gets the mesh
  skin,       ///< the inverse bind matrices change
  instances,  ///< the transforms of the copies change
};

/// A node with a mesh.
struct MeshNode {
  model::NodeIndex node = 0;
  Carrier carrier = Carrier::transform;
};

/// All places of one mesh.
struct MeshPlace {
  std::vector<MeshNode> nodes;
  std::set<std::uint32_t> skins;
  std::vector<model::Affine> transforms;  ///< to the scene, of nodes without skin
  double scale = 0;                       ///< greatest length in the scene of a vector of length 1
  bool in_scene = false;                  ///< the default scene draws it
  std::string obstacle;  ///< why its coordinates cannot change, half a sentence; or empty
};

/// What other objects do with nodes.
struct NodeUsers {
  bool any_may_be_pointed = false;      ///< a JSON pointer is completed at run time
  std::set<model::NodeIndex> moved;     ///< by an animation or pointer
  std::set<model::NodeIndex> weighted;  ///< with animated weights, mesh or skin
  std::set<model::NodeIndex> referred;  ///< by objects of extensions
  std::set<model::NodeIndex> joints;
};

/// The places of all meshes. All arguments must outlive it.
class MeshPlaces {
 public:
  MeshPlaces(const StepData& data, const AttributeRoles& roles);

  const MeshPlace& of(std::uint32_t mesh) const { return places_[mesh]; }
  const model::Pose& pose() const { return pose_; }

  /// The greatest distance in the scene between a point of the grid and the same point after the
  /// places took it up, which are stored in single precision. The points: up to `size` steps from
  /// the origin along each axis.
  double rounding(std::uint32_t mesh, const Grid& grid, double size) const;
  /// Edits the nodes of a mesh, except for its skins. Returns the number of new nodes.
  std::size_t place(std::uint32_t mesh, const Grid& grid, StepChanges& changes,
                    FormatChanges& formats) const;
  /// The new matrices of a skin; nothing: they cannot be read.
  std::optional<std::string> gridded_matrices(std::uint32_t skin, const Grid& grid) const;

 private:
  void read_users();
  void add_node(model::NodeIndex index);
  void add_skin(std::uint32_t skin, MeshPlace& place);
  double rounding_of_skin(std::uint32_t skin, const Grid& grid, double size) const;
  std::string find_obstacle(model::NodeIndex index, const MeshNode& node) const;
  bool has_copies(model::NodeIndex index) const;
  bool moves_only_its_mesh(model::NodeIndex index) const;
  void add_child(model::NodeIndex index, const Grid& grid, StepChanges& changes) const;
  void change_transform(model::NodeIndex index, const Grid& grid, StepChanges& changes) const;
  const model::Node& node(model::NodeIndex index) const { return data_.views.nodes[index]; }

  const StepData& data_;
  const AttributeRoles& roles_;
  const model::Pose pose_;
  const model::SceneGraph hierarchy_;
  NodeUsers users_;
  std::map<model::NodeIndex, InstancePlaces> instances_;
  model::MemoryBudget copy_bytes_{std::uint64_t{1} << 28U};             ///< of transforms of copies
  std::map<std::uint32_t, std::vector<model::Affine>> joint_matrices_;  ///< by skin, at rest
  mutable std::uint64_t joints_left_ = std::uint64_t{1} << 22U;         ///< for rounding()
  std::vector<MeshPlace> places_;                                       ///< by mesh
};

}  // namespace gltfx::steps
