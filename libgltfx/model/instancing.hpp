// SPDX-License-Identifier: Apache-2.0
/// Nodes that draw their mesh many times: EXT_mesh_gpu_instancing.
#pragma once

#include <optional>
#include <vector>

#include "model/memory_budget.hpp"
#include "model/node.hpp"
#include "model/resource_data.hpp"
#include "model/views.hpp"

namespace gltfx::model {

/// Transforms of the copies of a node's mesh, in the space of the node.
struct Instancing {
  bool readable = true;    ///< false: data that is missing, malformed, or beyond the budget
  bool too_large = false;  ///< beyond the budget
  std::vector<Affine> transforms;
};

/// The object with the accessors of transforms; json::kNoNode: the node draws its mesh once, or the
/// object is missing.
json::NodeId instance_attributes(const Asset& asset, const Node& node);

/// Nothing when the node draws its mesh once.
std::optional<Instancing> read_instancing(const Asset& asset, const Views& views,
                                          const ResourceData& resources, const Node& node,
                                          MemoryBudget& budget);

/// How many copies a node draws; nothing: their transforms are missing or malformed. Reads none.
std::optional<std::uint64_t> count_copies(const Asset& asset, const Views& views,
                                          const ResourceData& resources, const Node& node);

/// Where one of the copies is, in the space of the node; nothing when there are none, or none that
/// can be read.
std::optional<Vector3> place_of_copy(const Asset& asset, const Views& views,
                                     const ResourceData& resources, const Node& node);

}  // namespace gltfx::model
