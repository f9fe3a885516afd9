// SPDX-License-Identifier: Apache-2.0
/// The arrays of one document that references point into, and which of their elements are used.
#pragma once

#include <string>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "base/json_pointer.hpp"
#include "json/document.hpp"
#include "schema/check.hpp"
#include "schema/walk_tables.hpp"

namespace gltfx::schema {

class ReferenceTargets {
 public:
  ReferenceTargets(const json::Document& document, const Set& set);
  ReferenceTargets(const ReferenceTargets&) = delete;
  ReferenceTargets& operator=(const ReferenceTargets&) = delete;

  /// One array; `size` is 0 when the document does not have it.
  struct Array {
    json::NodeId node = json::kNoNode;
    std::uint64_t size = 0;
    UsedElements used;
    std::vector<bool> holes;  ///< elements that are not objects; empty when there are none
    /// By shape: whether elements have what it requires; filled by has_member().
    std::unordered_map<ShapeId, std::vector<bool>> having;
    bool is_array = false;
    bool is_hole(std::uint64_t index) const { return index < holes.size() && holes[index]; }
  };

  /// The array of a target from the root.
  Array& from_root(std::uint32_t target) { return arrays_[from_root_[target]]; }
  /// The array of a target below an object, found once per array; null when it is missing.
  Array* below(const Target& target, json::NodeId object, const Path& path);
  /// Whether the element has what `refHas` requires. Precondition: the index is below the size.
  bool has_member(Array& array, std::uint64_t index, ShapeId shape,
                  const std::vector<std::string>& steps) const;
  /// Whether a place of a name target holds that string.
  bool has_name(std::uint32_t target, std::string_view name);

  /// Moves the marks to `result`.
  void move_to(CheckResult& result);

 private:
  Array read(json::NodeId array) const;
  json::NodeId value_at(json::NodeId from, const std::vector<std::string>& steps) const;
  std::uint64_t largest(json::NodeId from, const std::vector<std::string>& steps) const;
  std::vector<json::NodeId> places(json::NodeId from, const std::vector<std::string>& steps) const;

  struct Local {
    Array array;
    std::string pointer;
  };
  const json::Document& document_;
  const Set::WalkTables& tables_;
  std::vector<Array> arrays_;             ///< the first one is for missing targets
  std::vector<std::uint32_t> from_root_;  ///< position in arrays_, by index of WalkTables::targets
  std::vector<Local> local_;
  std::unordered_map<json::NodeId, std::size_t> local_at_;
  std::unordered_map<std::uint32_t, std::unordered_set<std::string>> names_;
};

}  // namespace gltfx::schema
