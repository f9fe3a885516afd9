// SPDX-License-Identifier: Apache-2.0
#include "prove/placed_meshes.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

#include <fmt/format.h>

#include "model/pose.hpp"

namespace gltfx::prove {
namespace {

// Scales that change, as zeros: what lies below has no shape to compare. Nothing: all may change.
std::optional<model::AnimatedValues> changing_scales(const Side& side) {
  model::AnimatedValues scales;
  const auto add = [&](std::uint32_t node) {
    scales[fmt::format("/nodes/{}/scale", node)] = {0, 0, 0};
  };
  for (const model::Animation& animation : side.views().animations) {
    for (const model::AnimationChannel& channel : animation.channels) {
      if (channel.node && channel.path == model::AnimationPath::scale) add(*channel.node);
    }
  }
  for (const graph::PointerText& pointer : side.graph().pointers()) {
    const auto& steps = pointer.steps;
    if (steps.size() != 3 || steps[0] != "nodes" || steps[2] != "scale") continue;
    if (pointer.way.size() < 2) return std::nullopt;
    add(side.index(pointer.way[1]));
  }
  return scales;
}

// By node, from its space to that of the scene.
std::vector<model::Affine> world_of(const Side& side, const model::AnimatedValues& animated = {}) {
  const model::SceneRoots roots = model::choose_scene(side.asset(), side.views());
  return model::compute_pose(side.asset(), side.views(), roots, animated).world;
}

// Whether different shapes are different in the space of the scene.
bool keeps_shapes(const model::Affine& world) {
  constexpr double kFlat = 1e-6;  // of the volume of a cube with the longest edge
  double longest = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    longest = std::max(longest, std::sqrt(model::dot(world.columns[i], world.columns[i])));
  }
  return std::isfinite(longest) &&
         std::abs(world.determinant()) > kFlat * longest * longest * longest;
}

// Whether a reference to a node is its place in the scene graph.
bool is_of_hierarchy(const graph::Tree& tree, const graph::Use& use) {
  const json::NodeId list = use.at.element ? use.at.node : tree.parent(use.at.node);
  if (use.kind != graph::UseKind::index || !tree.is_member(list)) return false;
  const json::NodeId owner = tree.parent(list);
  return tree.root_element(owner) == owner &&
         (tree.name(list) == "children" || tree.name(list) == "nodes");
}

// What pointers may lead to, and what contains it; nothing: anything.
std::optional<std::unordered_set<json::NodeId>> pointed_values(const Side& side) {
  std::unordered_set<json::NodeId> values;
  for (const graph::PointerText& pointer : side.graph().pointers()) {
    if (pointer.varying != json::kNoNode) return std::nullopt;
    values.insert(pointer.way.begin(), pointer.way.end());
  }
  return values;
}

// Targets of channels that change weights of morph targets, not transforms.
std::unordered_set<json::NodeId> weight_targets(const Side& side) {
  std::unordered_set<json::NodeId> targets;
  for (const model::Animation& animation : side.views().animations) {
    for (const model::AnimationChannel& channel : animation.channels) {
      if (channel.path == model::AnimationPath::weights) targets.insert(channel.target);
    }
  }
  return targets;
}

bool moves_only_its_mesh(const Side& side, json::NodeId node,
                         const std::unordered_set<json::NodeId>& weights) {
  const json::Document& document = side.document();
  for (const char* member : {"camera", "children", "extensions"}) {
    if (document.holds(node, member)) return false;
  }
  const auto users = side.graph().users(node);
  return std::all_of(users.begin(), users.end(), [&](const graph::Use& use) {
    return is_of_hierarchy(side.tree(), use) || weights.contains(side.tree().parent(use.at.node));
  });
}

}  // namespace

void PlacedMeshes::find_movable(const Side& before, const NodePairs& nodes) {
  const auto unmoved = pointed_values(before);
  const auto weights = weight_targets(before);
  for (const Pair& pair : nodes.all()) {
    const model::Node& node = before.views().nodes[before.index(pair.ours)];
    const bool is_free = unmoved && !unmoved->contains(pair.ours);
    if (node.mesh && !node.skin && is_free && moves_only_its_mesh(before, pair.ours, weights))
      movable_.insert(pair.ours);
  }
}

PlacedMeshes::PlacedMeshes(const Side& before, const Side& after, const NodePairs& nodes,
                           const MeaningRequest& request) {
  if (request.regridded) find_movable(before, nodes);
  if (!request.in_world || request.order != VertexOrder::kept) return;
  const auto scales_here = changing_scales(before);
  const auto scales_there = changing_scales(after);
  if (!scales_here || !scales_there) return;
  const auto here = world_of(before), there = world_of(after);
  const auto least_here = world_of(before, *scales_here),
             least_there = world_of(after, *scales_there);
  std::vector<std::size_t> users(before.views().meshes.size());
  for (const Pair& node : nodes.all()) {
    const std::uint32_t one = before.index(node.ours), other = after.index(node.theirs);
    const model::Node& ours = before.views().nodes[one];
    const model::Node& theirs = after.views().nodes[other];
    if (!ours.mesh || !theirs.mesh || ours.skin || theirs.skin) continue;
    if (!keeps_shapes(least_here[one]) || !keeps_shapes(least_there[other])) continue;
    all_.push_back({node, &before.views().meshes[*ours.mesh], &after.views().meshes[*theirs.mesh],
                    here[one], there[other]});
    ++users[*ours.mesh];
  }
  const model::Mesh* const first = before.views().meshes.data();
  std::erase_if(all_, [&](const PlacedMesh& mesh) {
    return before.graph().users(mesh.ours->node).size() !=
           users[static_cast<std::size_t>(mesh.ours - first)];
  });
  const auto unmoved = pointed_values(before);
  const auto weights = weight_targets(before);
  for (const PlacedMesh& mesh : all_) {
    for (const model::Primitive& primitive : mesh.ours->primitives) {
      primitives_.insert(primitive.node);
    }
    const json::NodeId node = mesh.node.ours;
    const bool is_free = unmoved && !unmoved->contains(node);
    if (is_free && moves_only_its_mesh(before, node, weights)) movable_.insert(node);
  }
}

}  // namespace gltfx::prove
