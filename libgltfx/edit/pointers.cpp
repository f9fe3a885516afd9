// SPDX-License-Identifier: Apache-2.0
#include "edit/pointers.hpp"

#include <algorithm>

#include "base/json_pointer.hpp"

namespace gltfx::edit {
namespace {

std::string element_key(std::string_view array, std::string_view index) {
  std::string key(array);
  key.append(1, '/').append(index);
  return key;
}

}  // namespace

bool Pointers::is_template(const PointerUse& use) {
  return use.steps[1].find('{') != std::string::npos;
}

Pointers::Pointers(const json::Document& document) {
  const json::KeyId extras = document.key_id("extras");
  for (json::NodeId id = 0; id < document.node_count();) {
    const json::Node& node = document.node(id);
    if (node.kind == json::Kind::key) {
      id = node.next == extras ? document.next(id + 1) : id + 1;
      continue;
    }
    if (node.kind == json::Kind::string && document.raw(id).substr(0, 2) == "\"/") {
      auto steps = split_pointer(document.string(id));
      if (steps && steps->size() > 2) uses_.push_back({id, *std::move(steps)});
    }
    ++id;
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

}  // namespace gltfx::edit
