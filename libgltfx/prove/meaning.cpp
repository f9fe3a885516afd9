// SPDX-License-Identifier: Apache-2.0
#include "prove/meaning.hpp"

#include <algorithm>
#include <unordered_set>

#include "prove/curves.hpp"
#include "prove/differences.hpp"
#include "prove/geometry.hpp"
#include "prove/images.hpp"
#include "prove/node_pairs.hpp"
#include "prove/object_walk.hpp"
#include "prove/side.hpp"

namespace gltfx::prove {
namespace {

bool has_root_object(const model::OpenedAsset& opened) {
  const json::Document& document = opened.document();
  return !document.empty() && document.is_object(document.root());
}

/// A mesh at a node, in both assets.
struct PlacedMesh {
  Pair node;
  const model::Mesh* ours = nullptr;
  const model::Mesh* theirs = nullptr;
};

// Meshes whose places in the scene depend on their nodes only.
std::vector<PlacedMesh> placed_meshes(const Side& before, const Side& after,
                                      const NodePairs& nodes) {
  std::vector<PlacedMesh> placed;
  for (const auto& [ours, theirs] : nodes.all()) {
    const model::Node& here = before.views().nodes[before.index(ours)];
    const model::Node& there = after.views().nodes[after.index(theirs)];
    if (!here.mesh || !there.mesh || here.skin || there.skin) continue;
    placed.push_back(
        {{ours, theirs}, &before.views().meshes[*here.mesh], &after.views().meshes[*there.mesh]});
  }
  return placed;
}

void compare_geometry(const Side& before, const Side& after, const NodePairs& nodes,
                      const std::vector<Pair>& primitives, const MeaningRequest& request,
                      Differences& found) {
  const bool in_world = request.in_world && request.order == VertexOrder::kept;
  std::vector<PlacedMesh> placed;
  if (in_world) placed = placed_meshes(before, after, nodes);
  std::unordered_set<json::NodeId> in_place;
  for (const PlacedMesh& each : placed) {
    for (const model::Primitive& primitive : each.ours->primitives) in_place.insert(primitive.node);
  }
  for (const Pair& pair : primitives) {
    const bool positions = !in_place.contains(pair.ours);
    compare_primitives(before, after, pair.ours, pair.theirs, request, positions, found);
  }
  for (const PlacedMesh& each : placed) {
    const auto& ours = each.ours->primitives;
    const auto& theirs = each.theirs->primitives;
    for (std::size_t i = 0; i < std::min(ours.size(), theirs.size()); ++i) {
      if (ours[i].node == json::kNoNode || theirs[i].node == json::kNoNode) continue;
      compare_placed(before, after, {ours[i].node, before.world()[before.index(each.node.ours)]},
                     {theirs[i].node, after.world()[after.index(each.node.theirs)]}, each.node.ours,
                     request, found);
    }
  }
}

}  // namespace

Meaning compare_meaning(const model::OpenedAsset& before, const model::OpenedAsset& after,
                        const schema::Set& schemas, const MeaningRequest& request) {
  Differences found(request.most);
  if (!has_root_object(before)) return {};
  if (!has_root_object(after)) {
    found.add("", "is no longer glTF");
    return found.take();
  }
  const Side ours(before, schemas, request.jobs);
  const Side theirs(after, schemas, request.jobs);
  const NodePairs nodes(ours, theirs);
  const Payloads payloads = ObjectWalk(ours, theirs, nodes, request, found).run();
  compare_geometry(ours, theirs, nodes, payloads.primitives, request, found);
  for (const Pair& pair : payloads.channels) {
    compare_curves(ours, theirs, pair, request.tolerance.animation, found);
  }
  if (request.images != ImageComparison::none) {
    for (const Pair& pair : payloads.images) {
      compare_images(ours, theirs, pair, request.images, found);
    }
  }
  return found.take();
}

Meaning compare_meshes(const model::OpenedAsset& before, const model::OpenedAsset& after,
                       const schema::Set& schemas, const MeaningRequest& request) {
  Differences found(request.most);
  if (!has_root_object(before)) return {};
  if (!has_root_object(after)) {
    found.add("", "is no longer glTF");
    return found.take();
  }
  const Side ours(before, schemas, request.jobs);
  const Side theirs(after, schemas, request.jobs);
  const auto& here = ours.views().meshes;
  const auto& there = theirs.views().meshes;
  for (std::size_t i = 0; i < here.size(); ++i) {
    if (here[i].node == json::kNoNode) continue;
    if (i >= there.size() || there[i].primitives.size() != here[i].primitives.size()) {
      found.add(ours.pointer(here[i].node), "has another number of primitives");
      continue;
    }
    for (std::size_t k = 0; k < here[i].primitives.size(); ++k) {
      const json::NodeId one = here[i].primitives[k].node;
      const json::NodeId other = there[i].primitives[k].node;
      if (one == json::kNoNode || other == json::kNoNode) continue;
      compare_primitives(ours, theirs, one, other, request, true, found);
    }
  }
  return found.take();
}

}  // namespace gltfx::prove
