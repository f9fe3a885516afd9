// SPDX-License-Identifier: Apache-2.0
/// Compares the drawn shapes of primitives.
#pragma once

#include "model/node.hpp"
#include "prove/differences.hpp"
#include "prove/primitive_pair.hpp"

namespace gltfx::prove {

/// Compares all attributes of two primitives according to the request. Without `positions`,
/// POSITION is left out because the caller compares it separately.
void compare_primitives(const Side& before, const Side& after, json::NodeId ours,
                        json::NodeId theirs, const MeaningRequest& request, bool positions,
                        Differences& found);

/// A primitive and its transform to the scene.
struct Placed {
  json::NodeId primitive = json::kNoNode;
  model::Affine world;
};
/// Compares positions of corresponding corners in the space of the scene. `node` is in `before`.
void compare_placed(const Side& before, const Side& after, const Placed& ours, const Placed& theirs,
                    json::NodeId node, const MeaningRequest& request, Differences& found);

/// Compares as sets; see VertexOrder::free. `place` is the pointer to the primitive in `before`.
void compare_as_sets(const PrimitivePair& pair, const std::string& place, Differences& found);

}  // namespace gltfx::prove
