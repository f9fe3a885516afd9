// SPDX-License-Identifier: Apache-2.0
#include "steps/references.hpp"

#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "base/text.hpp"
#include "graph/extras.hpp"
#include "graph/unknown_indices.hpp"

namespace gltfx::steps {
namespace {

// Whether one of two values contains the other.
bool overlap(const json::Document& document, json::NodeId one, json::NodeId other) {
  const bool inside = one >= other && one < document.next(other);
  return inside || (other >= one && other < document.next(one));
}

// Whether VRM stores properties in the order of the materials.
bool has_parallel_list(const graph::Tree& tree, json::NodeId list) {
  if (tree.name(list) != "materials") return false;
  return tree.find("/extensions/VRM/materialProperties").node != json::kNoNode;
}

}  // namespace

std::optional<std::string> find_index_doubt(const graph::Graph& graph, json::NodeId list) {
  const graph::Tree& tree = graph.tree();
  const auto say = [&tree](std::string_view form, graph::Place place) {
    return fmt::format(fmt::runtime(form), printable(tree.pointer(place)));
  };
  for (const graph::PointerText& pointer : graph.pointers()) {
    if (pointer.varying == list || (pointer.varying != json::kNoNode && pointer.way.empty())) {
      return say("the target of the pointer at {} is set at run time", {pointer.at, std::nullopt});
    }
  }
  for (const graph::IndexUse& use : graph.indices()) {
    if (use.ambiguous != json::kNoNode && overlap(tree.document(), use.ambiguous, list)) {
      return say("the reference at {} is ambiguous", use.at);
    }
  }
  for (const graph::Use& use : graph.uses()) {
    if (use.kind == graph::UseKind::implied && tree.parent(use.target) == list) {
      return say("{} refers to one of them by default", use.at);
    }
  }
  if (has_parallel_list(tree, list)) {
    return "/extensions/VRM/materialProperties follows their order";
  }
  return std::nullopt;
}

std::optional<ConvertNote> find_unknown_index(
    const graph::Graph& graph, const std::function<bool(json::NodeId element)>& is_gone) {
  const graph::Tree& tree = graph.tree();
  for (const json::NodeId object : graph.unknown_extensions()) {
    if (!graph::may_hold_index(tree.document(), object)) continue;
    const json::NodeId element = tree.root_element(object);
    if (element != json::kNoNode && is_gone(element)) continue;
    return ConvertNote{tree.pointer(object), "may hold indices (describe it with --schema)"};
  }
  return std::nullopt;
}

std::optional<ConvertNote> find_offset_doubt(const graph::Graph& graph) {
  const json::NodeId unknown = graph::find_unknown_offset(graph);
  if (unknown == json::kNoNode) return std::nullopt;
  return ConvertNote{graph.tree().pointer(unknown),
                     "it may hold an offset into a buffer, so the bytes cannot move "
                     "(describe it with --schema)"};
}

std::optional<ConvertNote> find_indices_in_extras(const graph::Graph& graph) {
  const auto values = graph::likely_indices(
      graph.tree().document(), {"accessor", "buffer", "image", "index", "indices", "material",
                                "mesh", "sampler", "skin", "texture"});
  if (values.empty()) return std::nullopt;
  const std::string more =
      values.size() == 1 ? "" : fmt::format(", like {} more in extras", values.size() - 1);
  return ConvertNote{graph.tree().pointer(values.front()),
                     fmt::format("may be an index{}; it is not updated", more)};
}

}  // namespace gltfx::steps
