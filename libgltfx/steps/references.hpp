// SPDX-License-Identifier: Apache-2.0
/// Checks whether all references to objects are known, so that indices can change.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "graph/graph.hpp"
#include "steps/step.hpp"

namespace gltfx::steps {

/// Why the indices of a root array cannot change, half a sentence; nothing: they can. Does not
/// check extensions without a schema.
std::optional<std::string> find_index_doubt(const graph::Graph& graph, json::NodeId list);

/// The first object of an extension without a schema that may hold an index. Ignores objects in
/// elements of root arrays for which `is_gone` is true.
std::optional<ConvertNote> find_unknown_index(
    const graph::Graph& graph, const std::function<bool(json::NodeId element)>& is_gone);

/// A note about an extension without a schema that may hold an offset into a buffer, so that bytes
/// cannot move.
std::optional<ConvertNote> find_offset_doubt(const graph::Graph& graph);

/// A note about values in `extras` that may be indices; nothing if there are none. The values do
/// not change.
std::optional<ConvertNote> find_indices_in_extras(const graph::Graph& graph);

}  // namespace gltfx::steps
