// SPDX-License-Identifier: Apache-2.0
/// Extensions without a schema that may refer to anything by index.
#pragma once

#include "graph/graph.hpp"

namespace gltfx::graph {

/// Whether a value contains an integer.
bool may_hold_index(const json::Document& document, json::NodeId value);

/// The first object of an extension without a schema that contains an integer, which may be an
/// index; json::kNoNode: there is none.
json::NodeId find_unknown_with_integer(const Graph& graph);

/// The first such object that contains an integer as a member whose name contains "offset", which
/// may be a place in a buffer; json::kNoNode: there is none.
json::NodeId find_unknown_offset(const Graph& graph);

}  // namespace gltfx::graph
