// SPDX-License-Identifier: Apache-2.0
/// Meshes with other coordinates, whose places undo the change (MeaningRequest::regridded).
#pragma once

#include <optional>

#include "model/node.hpp"
#include "prove/differences.hpp"
#include "prove/meaning.hpp"
#include "prove/node_pairs.hpp"
#include "prove/side.hpp"

namespace gltfx::prove {

/// The new child that draws the mesh of a node in its place: without a name, the last of its
/// children, and one that no node of `before` corresponds to. Nothing: there is none.
std::optional<model::NodeIndex> find_mesh_child(const Side& after, const NodePairs& nodes,
                                                json::NodeId theirs);

/// Compares all positions in the space of the scene: of each node with a mesh, with all morph
/// targets at 0 and at 1; of skins at rest and in poses of the animations. Distances are parts of
/// the diagonal of the box of the scene of `before` at rest; of meshes that are not in the scene,
/// of their own box. Where a mesh has many places, the distance is an upper limit.
void compare_places(const Side& before, const Side& after, const NodePairs& nodes,
                    const MeaningRequest& request, Differences& found);

}  // namespace gltfx::prove
