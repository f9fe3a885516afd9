// SPDX-License-Identifier: Apache-2.0
/// Finds elements of root arrays that are equal except for indices.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

#include "graph/graph.hpp"

namespace gltfx::graph {

/// Maps elements to equal elements that replace them. The graph must outlive it.
class EqualObjects {
 public:
  explicit EqualObjects(const Graph& graph);

  /// The first element that equals this one.
  json::NodeId first(json::NodeId element) const {
    const auto found = first_.find(element);
    return found == first_.end() ? element : found->second;
  }
  bool is_merged(json::NodeId element) const { return first_.contains(element); }
  bool empty() const { return first_.empty(); }
  const std::unordered_map<json::NodeId, json::NodeId>& all() const { return first_; }
  /// Precondition: `first` is not merged itself.
  void merge(json::NodeId element, json::NodeId first) { first_[element] = first; }

  /// Appends a text that is identical for values with the same meaning. Members are sorted by name,
  /// and an index is replaced by the first element that equals its target. Strings and fractions
  /// are compared as they are written. Omits members, at any depth, for which `is_left_out` is
  /// true. Recursive, as deep as the document.
  void describe(json::NodeId value, const std::function<bool(json::NodeId value)>& is_left_out,
                std::string& to) const;

 private:
  using Place = std::pair<json::NodeId, std::uint64_t>;  ///< value, and position in a number_array

  void describe_number(const json::Number& number, Place place, std::string& to) const;

  const json::Document& document_;
  std::vector<std::pair<Place, json::NodeId>> targets_;  ///< targets of indices, sorted
  std::unordered_map<json::NodeId, json::NodeId> first_;
};

/// Groups elements by content. Each element is compared only with the first one of its hash, so the
/// time never grows with the square of their number.
class ContentGroups {
 public:
  /// The hash of the content of an element; nothing: the element equals no other.
  using Hash = std::function<std::optional<std::string>(json::NodeId element)>;
  using IsEqual = std::function<bool(json::NodeId one, json::NodeId other)>;

  /// Adds an element. Elements with equal descriptions may be equal. Call it in document order.
  void add(json::NodeId element, std::string description) {
    groups_[std::move(description)].push_back(element);
  }
  /// Pairs of an element and the first element that it equals, in document order.
  std::vector<std::pair<json::NodeId, json::NodeId>> find(const Hash& hash,
                                                          const IsEqual& is_equal) const;
  /// The same, for elements without content beyond the description.
  std::vector<std::pair<json::NodeId, json::NodeId>> find() const;

 private:
  std::map<std::string, std::vector<json::NodeId>> groups_;
};

}  // namespace gltfx::graph
