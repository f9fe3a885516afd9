// SPDX-License-Identifier: Apache-2.0
#include "graph/unknown_indices.hpp"

#include <algorithm>
#include <string>

namespace gltfx::graph {
namespace {

bool holds_offset(const json::Document& document, json::NodeId object) {
  for (json::NodeId id = object; id < document.next(object); ++id) {
    if (document.kind(id) != json::Kind::key || document.kind(id + 1) != json::Kind::number)
      continue;
    std::string name(document.key(document.node(id).next));
    std::transform(name.begin(), name.end(), name.begin(),
                   [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c; });
    if (name.find("offset") != name.npos && document.number(id + 1).is_integer()) return true;
  }
  return false;
}

template <class Holds>
json::NodeId find_unknown(const Graph& graph, const Holds& holds) {
  const auto& objects = graph.unknown_extensions();
  const auto found = std::find_if(objects.begin(), objects.end(), [&](json::NodeId object) {
    return holds(graph.tree().document(), object);
  });
  return found == objects.end() ? json::kNoNode : *found;
}

}  // namespace

bool may_hold_index(const json::Document& document, json::NodeId value) {
  for (json::NodeId id = value; id < document.next(value); ++id) {
    if (document.kind(id) == json::Kind::number && document.number(id).is_integer()) return true;
    if (document.kind(id) != json::Kind::number_array) continue;
    for (json::NumberCursor at(document, id); at.valid(); at.advance()) {
      if (at.number().is_integer()) return true;
    }
  }
  return false;
}

json::NodeId find_unknown_with_integer(const Graph& graph) {
  return find_unknown(graph, may_hold_index);
}

json::NodeId find_unknown_offset(const Graph& graph) { return find_unknown(graph, holds_offset); }

}  // namespace gltfx::graph
