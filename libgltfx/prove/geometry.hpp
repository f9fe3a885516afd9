// SPDX-License-Identifier: Apache-2.0
/// Whether primitives draw the same.
#pragma once

#include "model/node.hpp"
#include "prove/differences.hpp"
#include "prove/primitive_pair.hpp"

namespace gltfx::prove {

/// Compares all attributes of two primitives as the request says; without `positions` but for
/// POSITION, which somebody else compares.
void compare_primitives(const Side& before, const Side& after, json::NodeId ours,
                        json::NodeId theirs, const MeaningRequest& request, bool positions,
                        Differences& found);

/// A primitive at its place in the scene.
struct Placed {
  json::NodeId primitive = json::kNoNode;
  model::Affine world;
};
/// Compares positions, corner by corner, in the space of the scene. `node` is in `before`.
void compare_placed(const Side& before, const Side& after, const Placed& ours, const Placed& theirs,
                    json::NodeId node, const MeaningRequest& request, Differences& found);

/// Compares as sets; see VertexOrder::free. `place` is the pointer to the primitive in `before`.
void compare_as_sets(const PrimitivePair& pair, const std::string& place, Differences& found);

}  // namespace gltfx::prove
