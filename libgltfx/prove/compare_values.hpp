// SPDX-License-Identifier: Apache-2.0
/// Compares the values of matched objects, and names objects without a partner.
#pragma once

#include "prove/changes.hpp"

namespace gltfx::prove {

/// Nodes that only carry a mesh for their parent: with the transform that restores its positions.
struct Helpers {
  /// By node: the child that has its mesh, or kNoItem.
  std::vector<std::uint32_t> ours, theirs;
  /// Such children.
  std::set<std::uint32_t> our_nodes, their_nodes;
};

/// Nodes without a partner that only carry a mesh, below a node whose partner has a mesh itself.
Helpers find_helpers(const Comparison& comparison);

/// Values of objects and of the asset, extras, extensions and their lists.
void compare_values(const Comparison& comparison, const Helpers& helpers);

/// Lists of objects, of children and of the nodes of scenes in another order; counts on request.
void compare_order_of_lists(const Comparison& comparison);

/// Lists of extensions. Of extensions without a schema: what cannot be known.
void compare_extensions(const Comparison& comparison);

/// Objects that were added or removed. An object that only removed objects use is not named.
void compare_presence(const Comparison& comparison, const Helpers& helpers);

/// Of what stores data (accessors, views, buffers, samplers): names, extras and unknown extensions;
/// and samplers that nothing uses.
void compare_stored_objects(const Comparison& comparison);

}  // namespace gltfx::prove
