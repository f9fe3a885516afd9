// SPDX-License-Identifier: Apache-2.0
/// Meshes whose vertices are compared in the space of the scene (MeaningRequest::in_world).
#pragma once

#include <unordered_set>
#include <vector>

#include "model/mesh.hpp"
#include "model/node.hpp"
#include "prove/meaning.hpp"
#include "prove/node_pairs.hpp"
#include "prove/side.hpp"

namespace gltfx::prove {

/// A mesh at a node, before and after.
struct PlacedMesh {
  Pair node;
  const model::Mesh* ours = nullptr;
  const model::Mesh* theirs = nullptr;
  model::Affine here, there;  ///< from the space of the node to that of the scene
};

/// Valid as long as both sides.
class PlacedMeshes {
 public:
  /// A mesh of `before` is placed if each reference to it is that of a node without a skin whose
  /// place in the scene shows its shape: no scale on the way to the scene is 0 or changes. None is
  /// placed if the request does not ask for it.
  PlacedMeshes(const Side& before, const Side& after, const NodePairs& nodes,
               const MeaningRequest& request);

  const std::vector<PlacedMesh>& all() const { return all_; }
  /// Whether the mesh of a primitive of `before` is placed.
  bool has(json::NodeId primitive) const { return primitives_.contains(primitive); }
  /// Whether the transform of a node of `before` affects only the place of such a mesh.
  bool may_move(json::NodeId node) const { return movable_.contains(node); }

 private:
  void find_movable(const Side& before, const NodePairs& nodes);

  std::vector<PlacedMesh> all_;
  std::unordered_set<json::NodeId> primitives_, movable_;
};

}  // namespace gltfx::prove
