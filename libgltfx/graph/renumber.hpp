// SPDX-License-Identifier: Apache-2.0
/// References that follow the elements of lists to their new positions.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "graph/graph.hpp"
#include "json/edit.hpp"

namespace gltfx::graph {

/// The new position of the element of a list.
using NewPosition = std::function<std::uint64_t(json::NodeId list, std::uint64_t position)>;

/// Edits of the numbers and strings that refer to moved elements, except those for which `is_gone`
/// is true. Broken indices and steps stay.
std::vector<json::Edit> renumber(const Graph& graph, const NewPosition& now,
                                 const std::function<bool(Place)>& is_gone);

}  // namespace gltfx::graph
