// SPDX-License-Identifier: Apache-2.0
/// The tree of a document: the container and position of each value.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "json/document.hpp"

namespace gltfx::graph {

/// A value: a node, or an element of a number_array, which does not have a node.
struct Place {
  json::NodeId node = json::kNoNode;  ///< for an element: its array
  std::optional<std::uint64_t> element;
};

/// The time of all calls together is linear in their number and in the document. The document must
/// outlive it. Not thread-safe.
class Tree {
 public:
  explicit Tree(const json::Document& document);

  const json::Document& document() const { return document_; }
  /// The object or array that holds a value; kNoNode for the root.
  json::NodeId parent(json::NodeId value) const { return parents_[value]; }
  /// The position of an element in its array.
  std::uint32_t position(json::NodeId element) const { return positions_[element]; }
  /// The element of an array of the root object that is or contains the value; kNoNode: there is
  /// none.
  json::NodeId root_element(json::NodeId value) const;
  bool is_member(json::NodeId value) const {
    return value > 0 && document_.kind(value - 1) == json::Kind::key;
  }
  /// The name of a member.
  std::string_view name(json::NodeId value) const {
    return document_.key(document_.node(value - 1).next);
  }

  /// The number of elements or members, repeats included.
  std::uint64_t size(json::NodeId container) const;
  /// The element of a number_array that begins at that byte of the text.
  std::uint64_t number_at(json::NodeId array, std::uint32_t begin) const;
  /// The node of an element; kNoNode if there is none.
  json::NodeId element(json::NodeId array, std::uint64_t index) const;
  /// The value of a member; kNoNode if there is none.
  json::NodeId member(json::NodeId object, std::string_view name) const;
  /// The target of one pointer step from a value; a null node: none.
  Place step(json::NodeId from, std::string_view name) const;
  /// The place that a pointer names; a null node: it is broken, or not a pointer.
  Place find(std::string_view pointer) const;
  std::string pointer(Place place) const;
  std::string pointer(json::NodeId value) const { return pointer(Place{value, std::nullopt}); }

 private:
  const std::vector<json::NodeId>& elements(json::NodeId array) const;
  const std::vector<std::uint32_t>& numbers(json::NodeId array) const;

  const json::Document& document_;
  std::vector<json::NodeId> parents_;     ///< by node
  std::vector<std::uint32_t> positions_;  ///< by node
  std::vector<std::uint32_t> sizes_;      ///< by node, of containers with nodes
  mutable std::unordered_map<json::NodeId, std::vector<json::NodeId>> elements_;
  /// First bytes of the elements of number_arrays.
  mutable std::unordered_map<json::NodeId, std::vector<std::uint32_t>> numbers_;
  mutable std::unordered_map<std::uint64_t, json::NodeId> members_;  ///< by object and KeyId
  mutable std::unordered_set<json::NodeId> known_objects_;           ///< in members_
};

}  // namespace gltfx::graph
