// SPDX-License-Identifier: Apache-2.0
/// All references of a document. Only schemas define which values are references.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/span.hpp"
#include "graph/tree.hpp"
#include "json/document.hpp"
#include "schema/check.hpp"
#include "schema/set.hpp"

namespace gltfx::graph {

/// The kind of a reference.
enum class UseKind : std::uint8_t {
  index,
  pointer,  ///< a JSON pointer
  name,     ///< a name that is unique among the values that it may refer to
  implied,  ///< the default of a member that is absent
};

/// A reference to a value of the document.
struct Use {
  json::NodeId target = json::kNoNode;
  Place at;  ///< the number or string; UseKind::implied: the object without the member
  UseKind kind = UseKind::index;
};

/// An index, also a broken one.
struct IndexUse {
  Place at;
  Span span;               ///< of the number
  std::string_view array;  ///< pointer to the array if the schema names one: "/textures"
  std::uint64_t index = 0;
  json::NodeId list = json::kNoNode;  ///< the array that it points into; kNoNode: none
  /// The value that contains all possible arrays; kNoNode: there is only one array.
  json::NodeId ambiguous = json::kNoNode;
};

/// A string that is a JSON pointer, also a broken one.
struct PointerText {
  json::NodeId at = json::kNoNode;
  std::vector<std::string> steps;
  std::vector<json::NodeId>
      way;  ///< the value of each step; shorter than `steps` if the pointer is broken
  /// The value whose member or element is chosen at run time ("{i}", "[i]"); kNoNode: none.
  json::NodeId varying = json::kNoNode;
};

/// The result of one walk. The document and the Set must outlive it. Iterative; takes time
/// n log n. Not thread-safe, because its tree is not.
class Graph {
 public:
  /// `slots`: whether CheckResult::slots are filled.
  Graph(const json::Document& document, const schema::Set& set, bool slots = false);
  Graph(const Graph&) = delete;
  Graph& operator=(const Graph&) = delete;

  const Tree& tree() const { return tree_; }
  const schema::Set& set() const { return set_; }
  /// Other results of the walk.
  const schema::CheckResult& checked() const { return checked_; }

  /// In the order of the walk; indices in lists that may be references come last.
  const std::vector<IndexUse>& indices() const { return indices_; }
  const std::vector<PointerText>& pointers() const { return pointers_; }
  /// All references to existing values, sorted by target.
  const std::vector<Use>& uses() const { return uses_; }
  /// References to exactly this value.
  std::span<const Use> users(json::NodeId target) const;
  /// References that are in this value. `visit` takes a Use.
  template <class Visit>
  void each_use_in(json::NodeId value, const Visit& visit) const {
    for (std::size_t at = first_in(value); at < by_place_.size(); ++at) {
      const Use& use = uses_[by_place_[at]];
      if (use.at.node >= tree_.document().next(value)) return;
      visit(use);
    }
  }
  /// The values, and all that they refer to directly or indirectly. Sorted.
  std::vector<json::NodeId> closure(std::vector<json::NodeId> roots) const;

  /// Objects of extensions without a schema at their place: they may refer to anything.
  const std::vector<json::NodeId>& unknown_extensions() const { return unknown_; }
  /// Whether the elements of an array are references.
  bool is_list_of_references(json::NodeId array) const;
  /// The type of an object, or schema::kNone.
  schema::TypeId type(json::NodeId object) const { return types_[object]; }
  /// The shape that describes a value, or schema::kNone.
  schema::ShapeId shape(json::NodeId value) const;

 private:
  class Reader;
  std::size_t first_in(json::NodeId value) const;
  schema::ShapeId shape_of_child(json::NodeId parent, schema::ShapeId shape,
                                 json::NodeId child) const;

  const Tree tree_;
  const schema::Set& set_;
  schema::CheckResult checked_;
  std::vector<schema::TypeId> types_;  ///< by node
  std::vector<IndexUse> indices_;
  std::vector<PointerText> pointers_;
  std::vector<json::NodeId> unknown_;
  std::vector<Use> uses_;                ///< sorted by target
  std::vector<std::uint32_t> by_place_;  ///< positions in uses_, sorted by Use::at
};

}  // namespace gltfx::graph
