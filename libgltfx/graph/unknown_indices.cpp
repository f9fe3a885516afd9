// SPDX-License-Identifier: Apache-2.0
#include "graph/unknown_indices.hpp"

#include <algorithm>

namespace gltfx::graph {
namespace {

bool holds_integer(const json::Document& document, json::NodeId object) {
  for (json::NodeId id = object; id < document.next(object); ++id) {
    if (document.kind(id) == json::Kind::number && document.number(id).is_integer()) return true;
    if (document.kind(id) != json::Kind::number_array) continue;
    for (json::NumberCursor at(document, id); at.valid(); at.advance()) {
      if (at.number().is_integer()) return true;
    }
  }
  return false;
}

}  // namespace

json::NodeId find_unknown_with_integer(const Graph& graph) {
  const auto& objects = graph.unknown_extensions();
  const auto found = std::find_if(objects.begin(), objects.end(), [&](json::NodeId object) {
    return holds_integer(graph.tree().document(), object);
  });
  return found == objects.end() ? json::kNoNode : *found;
}

}  // namespace gltfx::graph
