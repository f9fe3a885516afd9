// SPDX-License-Identifier: Apache-2.0
#include "graph/pointers.hpp"

#include <algorithm>

#include "graph/graph.hpp"

namespace gltfx::graph {
namespace {

std::string element_key(std::string_view array, std::string_view index) {
  std::string key(array);
  key.append(1, '/').append(index);
  return key;
}

// Most documents have none, and need no graph.
bool has_pointer_text(const json::Document& document) {
  for (json::NodeId id = 0; id < document.node_count(); ++id) {
    if (document.kind(id) == json::Kind::string && document.raw(id).starts_with("\"/")) return true;
  }
  return false;
}

}  // namespace

bool Pointers::is_template(const PointerUse& use) {
  return use.steps[1].find('{') != std::string::npos;
}

Pointers::Pointers(const json::Document& document, const schema::Set& set) {
  if (!has_pointer_text(document)) return;
  const Graph graph(document, set);
  for (const PointerText& pointer : graph.pointers()) {
    if (pointer.steps.size() > 2) uses_.push_back({pointer.at, pointer.steps});
  }
  for (std::size_t i = 0; i < uses_.size(); ++i) {
    const std::vector<std::string>& steps = uses_[i].steps;
    by_element_[is_template(uses_[i]) ? steps[0] : element_key(steps[0], steps[1])].push_back(i);
  }
}

std::vector<const PointerUse*> Pointers::below(std::string_view array, std::string_view index,
                                               std::span<const std::string> steps) const {
  std::vector<const PointerUse*> found;
  for (const std::string& key : {element_key(array, index), std::string(array)}) {
    const auto known = by_element_.find(key);
    if (known == by_element_.end()) continue;
    for (const std::size_t use : known->second) {
      const std::vector<std::string>& has = uses_[use].steps;
      if (has.size() < steps.size() + 2) continue;
      if (std::equal(steps.begin(), steps.end(), has.begin() + 2)) found.push_back(&uses_[use]);
    }
  }
  return found;
}

bool Pointers::lead_below(std::string_view array, std::string_view index,
                          std::span<const std::string> steps) const {
  return !below(array, index, steps).empty();
}

}  // namespace gltfx::graph
