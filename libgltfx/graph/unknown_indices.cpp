// SPDX-License-Identifier: Apache-2.0
#include "graph/unknown_indices.hpp"

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

std::vector<json::NodeId> unknown_with_integers(const Graph& graph) {
  std::vector<json::NodeId> found;
  for (const json::NodeId object : graph.unknown_extensions()) {
    if (holds_integer(graph.tree().document(), object)) found.push_back(object);
  }
  return found;
}

}  // namespace gltfx::graph
