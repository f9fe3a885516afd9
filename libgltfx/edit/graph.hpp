// SPDX-License-Identifier: Apache-2.0
/// What refers to what in a document: indices, JSON pointers, and places of which nobody knows
/// whether they refer to anything.
#pragma once

#include <algorithm>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "base/span.hpp"
#include "edit/tree.hpp"
#include "json/document.hpp"
#include "schema/set.hpp"

namespace gltfx::edit {

/// An index, where it stands in the text.
struct IndexUse {
  Place at;
  Span span;  ///< of the number
  std::uint64_t index = 0;
  json::NodeId list = json::kNoNode;  ///< the array that it leads into; kNoNode: none
  /// One of several arrays is meant, all of which lie in this value; kNoNode: there is but one.
  json::NodeId ambiguous = json::kNoNode;
};

/// A string that is a JSON pointer.
struct PointerText {
  json::NodeId at = json::kNoNode;
  std::vector<std::string> steps;
  std::vector<json::NodeId> way;  ///< where each step leads; shorter than `steps`: to nothing more
  json::NodeId target() const { return way.empty() ? json::kNoNode : way.back(); }
  /// The value whose member or element is chosen at run time ("{i}", "[i]"); kNoNode: none is.
  json::NodeId varying = json::kNoNode;
};

/// An index that holds because a member is not there.
struct DefaultUse {
  json::NodeId owner = json::kNoNode;
  const schema::Property* property = nullptr;
  json::NodeId target = json::kNoNode;
};

/// The result of one walk. The document and the Set must outlive it.
class Graph {
 public:
  Graph(const Tree& tree, const schema::Set& set);

  const Tree& tree() const { return tree_; }
  const schema::Set& set() const { return set_; }
  const std::vector<IndexUse>& indices() const { return indices_; }
  const std::vector<PointerText>& pointers() const { return pointers_; }
  const std::vector<DefaultUse>& defaults() const { return defaults_; }
  /// Objects of extensions that no schema describes, or not there.
  const std::vector<json::NodeId>& unknown_extensions() const { return unknown_; }

  /// The type of an object, or schema::kNone.
  schema::TypeId type(json::NodeId object) const { return types_[object]; }
  /// The shape that describes a value, or schema::kNone.
  schema::ShapeId shape(json::NodeId value) const;
  /// Places that refer to exactly this value.
  template <class Visit>
  void each_user(json::NodeId target, const Visit& visit) const {
    auto at = std::lower_bound(users_.begin(), users_.end(), User{target, {}}, before);
    for (; at != users_.end() && at->target == target; ++at) visit(at->at);
  }

 private:
  struct User {
    json::NodeId target;
    Place at;
  };
  /// A list of numbers that may be indices.
  struct List {
    json::NodeId node;
    json::NodeId object;  ///< that has it
    const schema::Target* target;
  };
  static bool before(const User& a, const User& b) { return a.target < b.target; }

  void walk();
  void note_defaults(const schema::ObjectType& type, json::NodeId object);
  void note_lists(const schema::ObjectType& type, json::NodeId object);
  void note_indices(const List& list);
  void note_pointer(json::NodeId at);
  void find_unknown();
  schema::ShapeId shape_of_child(json::NodeId parent, schema::ShapeId shape,
                                 json::NodeId child) const;

  const Tree& tree_;
  const schema::Set& set_;
  std::vector<schema::TypeId> types_;  ///< by node
  std::vector<IndexUse> indices_;
  std::vector<PointerText> pointers_;
  std::vector<DefaultUse> defaults_;
  std::vector<List> lists_;
  std::vector<json::NodeId> unknown_;
  std::vector<User> users_;  ///< sorted by target
};

}  // namespace gltfx::edit
