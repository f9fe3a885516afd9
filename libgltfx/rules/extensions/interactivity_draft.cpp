// SPDX-License-Identifier: Apache-2.0
// This file is about one extension and names it.
#include "rules/extensions/interactivity_draft.hpp"

#include <algorithm>
#include <array>

#include "model/fields.hpp"
#include "rules/extension_walk.hpp"

namespace gltfx::validate {
namespace {

constexpr std::string_view kInteractivityDraftExtension = "KHR_interactivity";
constexpr std::array<std::string_view, 3> kMaps{"configuration", "values", "flows"};

bool has(const json::Document& document, json::NodeId object, std::string_view member) {
  return document.find(object, member) != json::kNoNode;
}

std::string_view mark_of_node(const json::Document& document, json::NodeId node) {
  if (!has(document, node, "declaration") && has(document, node, "type")) {
    return "nodes have a 'type'";
  }
  std::size_t empty = 0;
  for (const std::string_view name : kMaps) {
    const json::NodeId map = document.find(node, name);
    if (map == json::kNoNode) continue;
    if (document.is_array(map)) return "node sockets are arrays";
    if (document.is_object(map) && document.object_size(map) == 0) ++empty;
  }
  // A single one may be a mistake.
  return empty < 2 ? "" : "there are empty arrays";
}

std::string_view mark_of_graph(const json::Document& document, json::NodeId graph) {
  if (has(document, graph, "customEvents")) return "there are 'customEvents'";
  for (const json::NodeId variable : object_list(document, graph, "variables")) {
    if (variable != json::kNoNode && has(document, variable, "id")) return "variables have an 'id'";
  }
  for (const json::NodeId node : object_list(document, graph, "nodes")) {
    if (node == json::kNoNode) continue;
    const std::string_view mark = mark_of_node(document, node);
    if (!mark.empty()) return mark;
  }
  return {};
}

}  // namespace

std::string_view earlier_interactivity(const json::Document& document) {
  const json::NodeId object =
      model::extension_object(document, document.root(), kInteractivityDraftExtension);
  if (object == json::kNoNode) return {};
  if (!has(document, object, "graphs")) {
    return has(document, object, "nodes") ? "there is no 'graphs'" : std::string_view();
  }
  for (const json::NodeId graph : object_list(document, object, "graphs")) {
    if (graph == json::kNoNode) continue;
    const std::string_view mark = mark_of_graph(document, graph);
    if (!mark.empty()) return mark;
  }
  return {};
}

bool OutsideInteractivity::is_inside(const Path& path) {
  const Path* object = nullptr;  // the ancestor two steps below the root
  const Path* member = nullptr;  // and that one step below it
  for (const Path* step = &path; step->parent() != nullptr; step = step->parent()) {
    object = member;
    member = step;
  }
  return object != nullptr && !member->is_index() && !object->is_index() &&
         member->key() == "extensions" && object->key() == kInteractivityDraftExtension;
}

}  // namespace gltfx::validate
