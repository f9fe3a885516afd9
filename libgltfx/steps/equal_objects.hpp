// SPDX-License-Identifier: Apache-2.0
/// Which elements of root arrays are equal, whatever their indices.
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

namespace gltfx::steps {

/// Elements that stand for equal ones. The graph must outlive it.
class EqualObjects {
 public:
  explicit EqualObjects(const graph::Graph& graph);

  /// The first of all elements that are equal to this one.
  json::NodeId first(json::NodeId element) const {
    const auto found = first_.find(element);
    return found == first_.end() ? element : found->second;
  }
  bool is_merged(json::NodeId element) const { return first_.contains(element); }
  bool empty() const { return first_.empty(); }
  const std::unordered_map<json::NodeId, json::NodeId>& all() const { return first_; }
  /// Precondition: `first` is not merged itself.
  void merge(json::NodeId element, json::NodeId first) { first_[element] = first; }

  /// Appends a value as text that is the same for values that say the same: members by name, in
  /// place of indices the first of all elements that are equal to what they lead to. Strings and
  /// fractions count as they are written. Without members, at any depth, for which `is_left_out` is
  /// true. Recursive, as deep as the document.
  void describe(json::NodeId value, const std::function<bool(json::NodeId value)>& is_left_out,
                std::string& to) const;

 private:
  using Place = std::pair<json::NodeId, std::uint64_t>;  ///< with the element of a number_array

  void describe_number(const json::Number& number, Place place, std::string& to) const;

  const json::Document& document_;
  std::vector<std::pair<Place, json::NodeId>> targets_;  ///< of indices, sorted
  std::unordered_map<json::NodeId, json::NodeId> first_;
};

/// Sorts elements by what they hold. Content is compared with that of the first one only, so that
/// the time does not grow with the square of their number, whatever they hold.
class ContentGroups {
 public:
  /// The hash of the content of an element; nothing: it is equal to no other.
  using Hash = std::function<std::optional<std::string>(json::NodeId element)>;
  using IsEqual = std::function<bool(json::NodeId one, json::NodeId other)>;

  /// Elements with equal descriptions may be equal. In the order of the document.
  void add(json::NodeId element, std::string description) {
    groups_[std::move(description)].push_back(element);
  }
  /// Pairs of an element and the first that it is equal to, in the order of the document.
  std::vector<std::pair<json::NodeId, json::NodeId>> find(const Hash& hash,
                                                          const IsEqual& is_equal) const;
  /// Where the description says all.
  std::vector<std::pair<json::NodeId, json::NodeId>> find() const;

 private:
  std::map<std::string, std::vector<json::NodeId>> groups_;
};

}  // namespace gltfx::steps
