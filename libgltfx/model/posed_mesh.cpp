// SPDX-License-Identifier: Apache-2.0
#include "model/posed_mesh.hpp"

#include <algorithm>

#include "model/inverse.hpp"
#include "model/skin.hpp"

namespace gltfx::model {

RestNodes::RestNodes(const GeometrySource& source, const SceneGraph& graph)
    : source_(source), graph_(graph), scratch_(source.views.nodes.size()) {
  locals_.reserve(source.views.nodes.size());
  for (const Node& node : source.views.nodes) {
    locals_.push_back(node.object == json::kNoNode ? Affine()
                                                   : stored_transform(source.asset, node));
  }
}

Affine RestNodes::local(NodeIndex node, const PosedMoment& at) const {
  if (at.clip == nullptr || !at.clip->moves(node)) return locals_[node];
  return at.between ? at.clip->transform_at(node, *at.between)
                    : at.clip->transform(node, at.moment);
}

const RestNodes::BoundSkin& RestNodes::skin(std::uint32_t index) {
  const auto [known, is_new] = skins_.try_emplace(index);
  if (!is_new) return known->second;
  if (unmoved_.world.empty()) unmoved_.world.resize(source_.views.nodes.size());
  known->second.joints =
      read_skin(source_.asset, source_.asset.elements(RootArray::skins)[index]).joint_nodes;
  known->second.inverse_bind =
      joint_matrices(source_.asset, source_.views, source_.resources, index, unmoved_);
  return known->second;
}

PosedMesh::PosedMesh(RestNodes& nodes, NodeIndex upper, NodeIndex node)
    : nodes_(nodes), upper_(upper), node_(node) {
  const Node& own = nodes.source().views.nodes[node];
  if (own.mesh && own.skin) {
    skin_ = &nodes.skin(*own.skin);
    sound_ = !skin_->inverse_bind.empty() && skin_->inverse_bind.size() == skin_->joints.size();
    if (!sound_) return;
    std::unordered_set<NodeIndex> seen;
    for (const NodeIndex joint : skin_->joints) climb(joint, seen);
    climb(upper, seen);
    return;
  }
  for (NodeIndex at = node; at != upper && at != kNoNodeIndex; at = nodes.graph().parent(at)) {
    way_.push_back(at);
  }
  std::reverse(way_.begin(), way_.end());
}

// Adds a node and those above it, parents first.
void PosedMesh::climb(NodeIndex from, std::unordered_set<NodeIndex>& seen) {
  const std::size_t first = way_.size();
  for (NodeIndex at = from; at != kNoNodeIndex; at = nodes_.graph().parent(at)) {
    if (!seen.insert(at).second) break;
    way_.push_back(at);
  }
  std::reverse(way_.begin() + static_cast<std::ptrdiff_t>(first), way_.end());
}

bool PosedMesh::is_moved_by(const ClipMoments& clip) const {
  if (clip.times().empty()) return false;
  const auto& mesh = nodes_.source().views.nodes[node_].mesh;
  if (mesh && clip.morphs(node_, *mesh)) return true;
  return std::any_of(way_.begin(), way_.end(), [&](NodeIndex each) { return clip.moves(each); });
}

bool PosedMesh::place(const PosedMoment& at, std::vector<Affine>& matrices) {
  if (skin_ == nullptr) {
    matrices.assign(1, Affine());
    for (const NodeIndex each : way_) matrices[0] = matrices[0] * nodes_.local(each, at);
    return true;
  }
  std::vector<Affine>& world = nodes_.scratch();
  for (const NodeIndex each : way_) {
    const NodeIndex parent = nodes_.graph().parent(each);
    world[each] =
        parent == kNoNodeIndex ? nodes_.local(each, at) : world[parent] * nodes_.local(each, at);
  }
  const auto to_upper = upper_ == kNoNodeIndex ? std::optional(Affine()) : inverse(world[upper_]);
  if (!to_upper) return false;
  matrices.clear();
  for (std::size_t i = 0; i < skin_->joints.size(); ++i) {
    matrices.push_back(*to_upper * world[skin_->joints[i]] * skin_->inverse_bind[i]);
  }
  return true;
}

std::vector<float> PosedMesh::weights(const PosedMoment& at) const {
  const GeometrySource& source = nodes_.source();
  const auto& mesh = source.views.nodes[node_].mesh;
  if (!mesh) return {};
  if (at.clip == nullptr || !at.clip->morphs(node_, *mesh)) {
    return morph_weights(source.asset, source.views, node_);
  }
  return morph_weights(source.asset, source.views, node_,
                       at.clip->weights_at(node_, *mesh, at.time()));
}

}  // namespace gltfx::model
