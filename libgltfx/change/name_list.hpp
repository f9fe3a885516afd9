// SPDX-License-Identifier: Apache-2.0
/// Edits of extensionsUsed and extensionsRequired.
#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "json/edit.hpp"

namespace gltfx::change {

/// One list of names in the root. Changes are collected and then made together, because a list that
/// loses all of its names is removed.
class NameList {
 public:
  NameList(const json::Document& document, std::string_view member);

  /// False: the member is not a list and is not changed.
  bool can_change() const { return usable_; }
  bool has(std::string_view name) const { return count(name) > 0; }
  /// Pointers to a name in the document's list: "/extensionsUsed/2".
  std::vector<std::string> places(std::string_view name) const;
  /// Replaces `from` by `to`; removes `from` if `to` is in the list already.
  void replace(std::string_view from, std::string_view to);
  void remove(std::string_view name);
  /// Removes one name of the document's list, by its node.
  void remove_at(json::NodeId node);
  /// Removes all names that are keys of `names`; returns those that were in the list.
  std::set<std::string> remove_all(const std::map<std::string, json::NodeId>& names);
  /// Adds a name at the end unless it is in the list.
  void add(std::string_view name);
  void apply(json::Editor& editor) const;

 private:
  /// How often a name is in the list now.
  std::int64_t count(std::string_view name) const;
  std::int64_t& count_of(std::string_view name);
  /// The present text of a name of the document; empty: removed.
  std::string text_of(json::NodeId node) const;
  /// Changes the text of a name of the document, or removes it if `to` is empty.
  void change(json::NodeId node, std::string_view from, std::string_view to);

  const json::Document& document_;
  std::string member_;
  json::NodeId list_;
  bool usable_ = true;                         ///< false: not a list of names, which is not changed
  json::KeyTable names_;                       ///< each once
  std::vector<std::int64_t> counts_;           ///< by KeyId
  std::map<json::NodeId, std::string> texts_;  ///< of names of the document that have changed
  std::vector<std::string> added_;
};

}  // namespace gltfx::change
