// SPDX-License-Identifier: Apache-2.0
/// Whether all references to objects are known, so that the objects can get other indices.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "graph/graph.hpp"
#include "steps/step.hpp"

namespace gltfx::steps {

/// Why elements of a root array cannot get other indices, half a sentence; nothing: they can, apart
/// from extensions without a schema.
std::optional<std::string> find_index_doubt(const graph::Graph& graph, json::NodeId list);

/// The first object of an extension without a schema that may hold an index, and is not inside an
/// element of a root array for which `is_gone` is true.
std::optional<ConvertNote> find_unknown_index(
    const graph::Graph& graph, const std::function<bool(json::NodeId element)>& is_gone);

/// A note about values in `extras` that may be indices, unless there are none. They stay as they
/// are.
std::optional<ConvertNote> find_indices_in_extras(const graph::Graph& graph);

}  // namespace gltfx::steps
