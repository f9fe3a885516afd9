// SPDX-License-Identifier: Apache-2.0
#include "rules/shows/placed_scene.hpp"

#include <algorithm>

#include "model/external_places.hpp"
#include "model/instancing.hpp"
#include "model/scene_box.hpp"
#include "rules/shows/shows.hpp"

namespace gltfx::validate {
namespace {

using model::AnimationPath;
using model::NodeIndex;
using model::RootArray;

// Primitives of all nodes together. Larger scenes are not looked at.
constexpr std::size_t kMostParts = std::size_t{1} << 17U;

BoundsBox moved_box(const model::Affine& transform, const BoundsBox& box) {
  const model::Box moved = model::moved_box(transform, {box.least, box.most});
  return {moved.least, moved.greatest};
}

bool draws_copies(const DataPhase& phase, const model::Node& node) {
  if (node.extensions == json::kNoNode) return false;
  model::MemoryBudget none(0);
  return model::read_instancing(phase.context.asset, phase.context.views, phase.resources, node,
                                none)
      .has_value();
}

}  // namespace

PlacedScene::PlacedScene(DataPhase& phase)
    : phase_(phase),
      context_(phase.context),
      pose_(phase.pose()),
      meshes_(context_.views.meshes.size(), 0),
      moves_(context_.views.nodes.size(), 0) {
  find_moving();
  for (NodeIndex i = 0; i < context_.views.nodes.size(); ++i) {
    if (pose_.in_scene[i] != 0 && pose_.visible[i] != 0 && context_.views.nodes[i].mesh) place(i);
  }
  const auto places = model::external_places(context_.document, context_.views);
  external_ = std::any_of(places.begin(), places.end(), [this](const model::ExternalPlace& each) {
    return pose_.in_scene[each.node] != 0 && pose_.visible[each.node] != 0;
  });
  complete_ = complete_ && !external_;
}

// From the nodes that animations name down to what is below them.
void PlacedScene::find_moving() {
  std::vector<NodeIndex> open;
  for (const model::Animation& animation : context_.views.animations) {
    for (const model::AnimationChannel& channel : animation.channels) {
      if (channel.path == AnimationPath::other) moves_all_ = moves_any_ = true;
      const bool moves = channel.path == AnimationPath::translation ||
                         channel.path == AnimationPath::rotation ||
                         channel.path == AnimationPath::scale;
      if (moves && channel.node) open.push_back(*channel.node);
    }
  }
  moves_any_ = moves_any_ || !open.empty();
  while (!open.empty()) {
    const NodeIndex node = open.back();
    open.pop_back();
    if (moves_[node] != 0) continue;
    moves_[node] = 1;
    model::for_each_index(context_.asset, context_.views.nodes[node].children, RootArray::nodes,
                          [&](std::uint64_t, std::optional<std::uint32_t> child, Span) {
                            if (child) open.push_back(*child);
                          });
  }
}

void PlacedScene::place(NodeIndex index) {
  const model::Node& node = context_.views.nodes[index];
  const std::uint32_t mesh = *node.mesh;
  meshes_[mesh] = std::max(meshes_[mesh], node.skin ? kSkinned : kDrawn);
  const auto& primitives = context_.views.meshes[mesh].primitives;
  if (node.skin || draws_copies(phase_, node) || parts_.size() + primitives.size() > kMostParts) {
    complete_ = false;
    return;
  }
  for (std::uint32_t i = 0; i < primitives.size(); ++i) {
    const BoundsBox own = phase_.box_of_primitive(primitives[i]);
    const BoundsBox box = is_sound(own) ? moved_box(pose_.world[index], own) : own;
    if (is_sound(box)) {
      parts_.push_back({index, mesh, i, box});
    } else {
      complete_ = false;
    }
  }
}

void check_geometry(DataPhase& phase) {
  if (phase.context.views.meshes.empty()) return;
  PlacedScene scene(phase);
  check_wrong_sides(phase, scene);
  check_placement(phase, scene);
  check_coincidence(phase, scene);
  check_camera_backs(phase, scene);
}

}  // namespace gltfx::validate
