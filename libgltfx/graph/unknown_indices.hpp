// SPDX-License-Identifier: Apache-2.0
/// Extensions without a schema that may refer to anything by index.
#pragma once

#include <vector>

#include "graph/graph.hpp"

namespace gltfx::graph {

/// Objects of extensions that no schema describes where they are and that hold a whole number, in
/// the order of the text: it may be an index.
std::vector<json::NodeId> unknown_with_integers(const Graph& graph);

}  // namespace gltfx::graph
