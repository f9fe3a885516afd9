// SPDX-License-Identifier: Apache-2.0
#include "prove/meaning.hpp"

#include <algorithm>

#include "prove/curves.hpp"
#include "prove/differences.hpp"
#include "prove/geometry.hpp"
#include "prove/images.hpp"
#include "prove/node_pairs.hpp"
#include "prove/object_walk.hpp"
#include "prove/placed_meshes.hpp"
#include "prove/regridded.hpp"
#include "prove/side.hpp"

namespace gltfx::prove {
namespace {

bool has_root_object(const model::OpenedAsset& opened) {
  const json::Document& document = opened.document();
  return !document.empty() && document.is_object(document.root());
}

// Compares both assets where `before` has a text. `compare` takes both sides
// and the differences.
template <class Compare>
Meaning compare_sides(const model::OpenedAsset& before, const model::OpenedAsset& after,
                      const schema::Set& schemas, Scope scope, const MeaningRequest& request,
                      const Compare& compare) {
  Differences found(request.most);
  if (!has_root_object(before)) return {};
  if (has_root_object(after)) {
    const Side ours(before, schemas, scope, request.jobs);
    const Side theirs(after, schemas, scope, request.jobs);
    compare(ours, theirs, found);
  } else {
    found.add("", "is no glTF any more");
  }
  return found.take();
}

std::string key_of(const Side& before, const Side& after, const Pair& primitives, bool positions) {
  return (positions ? "+" : "-") + storage_key(before, primitives.ours) + "|" +
         storage_key(after, primitives.theirs);
}

void compare_geometry(const Side& before, const Side& after, const PlacedMeshes& placed,
                      const std::vector<Pair>& primitives, const MeaningRequest& request,
                      Differences& found) {
  Compared compared;
  for (const Pair& pair : primitives) {
    const bool positions = !placed.has(pair.ours) && !request.regridded;
    if (!compared.add(key_of(before, after, pair, positions))) continue;
    compare_primitives(before, after, pair.ours, pair.theirs, request, positions, found);
  }
  for (const PlacedMesh& each : placed.all()) {
    const auto& ours = each.ours->primitives;
    const auto& theirs = each.theirs->primitives;
    for (std::size_t i = 0; i < std::min(ours.size(), theirs.size()); ++i) {
      if (ours[i].node == json::kNoNode || theirs[i].node == json::kNoNode) continue;
      compare_placed(before, after, {ours[i].node, each.here}, {theirs[i].node, each.there},
                     each.node.ours, request, found);
    }
  }
}

}  // namespace

Meaning compare_meaning(const model::OpenedAsset& before, const model::OpenedAsset& after,
                        const schema::Set& schemas, const MeaningRequest& request) {
  const bool images = request.images != ImageComparison::none;
  const auto compare = [&](const Side& ours, const Side& theirs, Differences& found) {
    const NodePairs nodes(ours, theirs);
    const PlacedMeshes placed(ours, theirs, nodes, request);
    const Payloads payloads = ObjectWalk(ours, theirs, nodes, placed, request, found).run();
    compare_geometry(ours, theirs, placed, payloads.primitives, request, found);
    if (request.regridded) compare_places(ours, theirs, nodes, request, found);
    Compared curves;
    for (const Pair& pair : payloads.channels) {
      if (!curves.add(curve_key(ours, pair.ours) + "|" + curve_key(theirs, pair.theirs))) continue;
      compare_curves(ours, theirs, pair, request.tolerance, found);
    }
    if (!images) return;
    for (const Pair& pair : payloads.images) {
      compare_images(ours, theirs, pair, request.images, found);
    }
  };
  return compare_sides(before, after, schemas, images ? Scope::all : Scope::without_images, request,
                       compare);
}

}  // namespace gltfx::prove
