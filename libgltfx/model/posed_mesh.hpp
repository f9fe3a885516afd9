// SPDX-License-Identifier: Apache-2.0
/// The place of a mesh in the space of a node above it, or of any node if it is skinned.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <unordered_set>
#include <vector>

#include "model/clip_moments.hpp"
#include "model/geometry.hpp"
#include "model/pose.hpp"
#include "model/scene_graph.hpp"

namespace gltfx::model {

/// A moment of an animation; without one, the asset at rest.
struct PosedMoment {
  ClipMoments* clip = nullptr;
  std::size_t moment = 0;
  std::optional<double> between = {};  ///< the time, in place of that of the moment

  double time() const { return between ? *between : clip->times()[moment]; }
};

/// Transforms of nodes at rest, and skins, each read once. The source must outlive it.
class RestNodes {
 public:
  struct BoundSkin {
    std::vector<NodeIndex> joints;
    std::vector<Affine> inverse_bind;  ///< by joint; empty: the skin cannot be read
  };

  RestNodes(const GeometrySource& source, const SceneGraph& graph);
  const GeometrySource& source() const { return source_; }
  const SceneGraph& graph() const { return graph_; }
  Affine local(NodeIndex node, const PosedMoment& at) const;
  const BoundSkin& skin(std::uint32_t index);
  /// Room for transforms of all nodes.
  std::vector<Affine>& scratch() { return scratch_; }

 private:
  const GeometrySource& source_;
  const SceneGraph& graph_;
  std::vector<Affine> locals_;  ///< by node
  std::map<std::uint32_t, BoundSkin> skins_;
  std::vector<Affine> scratch_;
  Pose unmoved_;  ///< for joint_matrices()
};

class PosedMesh {
 public:
  /// Of the mesh of `node`, in the space of `upper`. Precondition: `upper` is `node` or above it,
  /// or kNoNodeIndex for the scene.
  PosedMesh(RestNodes& nodes, NodeIndex upper, NodeIndex node);

  /// The nodes that are looked at for each pose.
  std::size_t steps() const { return way_.size(); }
  /// 0: it is not skinned.
  std::size_t joints() const { return skin_ == nullptr ? 0 : skin_->inverse_bind.size(); }
  /// False: it cannot be placed.
  bool is_sound() const { return sound_; }
  /// Whether an animation may change the place or the morph targets.
  bool is_moved_by(const ClipMoments& clip) const;
  /// One matrix, or one for each joint. False: there is none, because a scale is 0.
  bool place(const PosedMoment& at, std::vector<Affine>& matrices);
  /// The weights of morph targets.
  std::vector<float> weights(const PosedMoment& at) const;

 private:
  void climb(NodeIndex from, std::unordered_set<NodeIndex>& seen);

  RestNodes& nodes_;
  NodeIndex upper_, node_;
  const RestNodes::BoundSkin* skin_ = nullptr;
  bool sound_ = true;
  /// Rigid: from below `upper` to the node. Skinned: all above joints and `upper`, parents first.
  std::vector<NodeIndex> way_;
};

}  // namespace gltfx::model
