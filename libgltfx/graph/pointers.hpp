// SPDX-License-Identifier: Apache-2.0
/// JSON pointers of animations and of interactivity graphs, by the objects that they lead into.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "json/document.hpp"
#include "schema/set.hpp"

namespace gltfx::graph {

/// A string that is a pointer into a root array, or a template of such pointers
/// ("/materials/{i}/...").
struct PointerUse {
  json::NodeId node = json::kNoNode;
  std::vector<std::string> steps;
};

class Pointers {
 public:
  Pointers(const json::Document& document, const schema::Set& set);

  /// Pointers and templates that lead to, or below, a place of an element of a root array.
  std::vector<const PointerUse*> below(std::string_view array, std::string_view index,
                                       std::span<const std::string> steps) const;
  /// Whether a pointer leads to, or below, a place of an element of a root array. A template leads
  /// to every element.
  bool lead_below(std::string_view array, std::string_view index,
                  std::span<const std::string> steps) const;
  const std::vector<PointerUse>& all() const { return uses_; }
  static bool is_template(const PointerUse& use);

 private:
  std::vector<PointerUse> uses_;
  /// Positions in uses_ by the first two steps, "materials/3"; templates by the first.
  std::unordered_map<std::string, std::vector<std::size_t>> by_element_;
};

}  // namespace gltfx::graph
