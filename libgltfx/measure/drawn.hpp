// SPDX-License-Identifier: Apache-2.0
/// What a scene draws.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "measure/source.hpp"
#include "model/memory_budget.hpp"
#include "model/node.hpp"

namespace gltfx::measure {

/// Whether each node is one that MSFT_lod lists as a lower level of another.
std::vector<bool> lower_levels(const Source& source);
/// See Source::nodes_of(). Linear in the nodes.
SceneNodes find_nodes(const Source& source, std::uint32_t scene, const std::vector<bool>& lower);

/// Bounds the work of measures that look at each scene: a file may list one node in many scenes.
/// False: the scenes before that one have taken all of it.
bool is_affordable(const Source& source, std::uint32_t scene);

/// Reasons why what a scene draws is not known, one sentence.
inline constexpr std::string_view kTooManyScenes = "Too many scenes share nodes.";
inline constexpr std::string_view kUnreadCopies = "The transforms of copies cannot be read.";
inline constexpr std::string_view kTooMuchDrawn =
    "The scenes have too many copies, joints or weights.";

/// The linear part of a transform.
using Linear = std::array<model::Vector3, 3>;
inline Linear linear_part(const model::Affine& transform) {
  return {transform.columns[0], transform.columns[1], transform.columns[2]};
}
bool is_finite(const Linear& linear);
/// How much larger all areas become; nothing: that depends on their directions.
std::optional<double> common_factor(const Linear& linear);

/// How a node moves the vertices of its mesh before its transform does.
struct MeshPose {
  std::vector<float> weights;             ///< of morph targets; empty: no target has an effect
  std::span<const model::Affine> joints;  ///< matrices of the skin; empty: it has none

  bool is_rigid() const { return weights.empty() && joints.empty(); }
};

/// What scenes draw of each mesh. Weights, matrices of joints and transforms of copies have one
/// budget, for all nodes and scenes together: a few bytes may stand for millions of them.
class DrawnMeshes {
 public:
  explicit DrawnMeshes(const Source& source) : source_(source) {}
  DrawnMeshes(const DrawnMeshes&) = delete;
  DrawnMeshes& operator=(const DrawnMeshes&) = delete;

  /// Goes to a scene. Precondition: it is affordable.
  void enter(std::uint32_t scene);
  /// The nodes that draw each mesh.
  const std::map<std::uint32_t, std::vector<model::NodeIndex>>& by_mesh() const { return by_mesh_; }

  /// Nothing, and a reason in why(): beyond the budget. Valid until enter() is called.
  std::optional<MeshPose> pose_of(model::NodeIndex node);
  /// To the space of the scene, of each copy. Empty, and a reason in why(): they are not known.
  std::vector<model::Affine> transforms_of(model::NodeIndex node, const MeshPose& pose);
  std::string_view why() const { return why_; }

 private:
  static constexpr std::uint64_t kBytes = std::uint64_t{1} << 28U;

  bool has_own_weights(model::NodeIndex node) const;
  std::optional<std::vector<float>> weights_of(model::NodeIndex node);
  std::optional<std::span<const model::Affine>> joints_of(std::uint32_t skin);

  const Source& source_;
  model::MemoryBudget budget_{kBytes};
  std::uint32_t scene_ = 0;
  std::map<std::uint32_t, std::vector<model::NodeIndex>> by_mesh_;
  std::map<std::uint32_t, std::vector<float>> mesh_weights_;            // as MeshPose::weights
  std::map<std::uint32_t, std::vector<model::Affine>> joint_matrices_;  // by skin
  std::string_view why_;
};

}  // namespace gltfx::measure
