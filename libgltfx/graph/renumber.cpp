// SPDX-License-Identifier: Apache-2.0
#include "graph/renumber.hpp"

#include <optional>
#include <string>

#include "base/json_pointer.hpp"
#include "json/writer.hpp"

namespace gltfx::graph {
namespace {

// The text of a pointer to the same value; empty if it does not change.
std::string moved(const Tree& tree, const PointerText& pointer, const NewPosition& now) {
  std::string text;
  bool changed = false;
  json::NodeId holder = tree.document().root();
  for (std::size_t i = 0; i < pointer.steps.size(); ++i) {
    const json::NodeId value = i < pointer.way.size() ? pointer.way[i] : json::kNoNode;
    const bool element = value != json::kNoNode && !tree.is_member(value);
    const std::uint64_t position = element ? now(holder, tree.position(value)) : 0;
    changed = changed || (element && position != tree.position(value));
    append_pointer_step(text, element ? std::to_string(position) : pointer.steps[i]);
    holder = value;
  }
  return changed ? text : std::string();
}

}  // namespace

std::vector<json::Edit> renumber(const Graph& graph, const NewPosition& now,
                                 const std::function<bool(Place)>& is_gone) {
  const Tree& tree = graph.tree();
  std::vector<json::Edit> edits;
  for (const IndexUse& use : graph.indices()) {
    if (use.list == json::kNoNode || use.index >= tree.size(use.list) || is_gone(use.at)) continue;
    const std::uint64_t position = now(use.list, use.index);
    if (position != use.index) edits.push_back({use.span, std::to_string(position)});
  }
  for (const PointerText& pointer : graph.pointers()) {
    if (is_gone({pointer.at, std::nullopt})) continue;
    const std::string text = moved(tree, pointer, now);
    if (text.empty()) continue;
    std::string json;
    json::append_string(json, text);
    edits.push_back({tree.document().span(pointer.at), std::move(json)});
  }
  return edits;
}

}  // namespace gltfx::graph
