// SPDX-License-Identifier: Apache-2.0
/// extensionsUsed and extensionsRequired, where names come and go.
#pragma once

#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "json/edit.hpp"

namespace gltfx::edit {

/// One list of names in the root. Changes are collected and then made together, because a list that
/// loses all of its names goes itself.
class NameList {
 public:
  NameList(const json::Document& document, std::string_view member);

  bool has(std::string_view name) const;
  /// Pointers to a name in the document's list: "/extensionsUsed/2".
  std::vector<std::string> places(std::string_view name) const;
  /// Puts `to` in the place of `from`; takes `from` out when `to` is there already.
  void replace(std::string_view from, std::string_view to);
  void remove(std::string_view name);
  /// Takes out all names that are keys of `names`; gives those that were there.
  std::set<std::string> remove_all(const std::map<std::string, json::NodeId>& names);
  /// Adds a name at the end unless it is there.
  void add(std::string_view name);
  void apply(json::Editor& editor) const;

 private:
  struct Entry {
    json::NodeId node = json::kNoNode;  ///< kNoNode: new
    std::string was, is;                ///< `is` empty: taken out
  };
  const json::Document& document_;
  std::string member_;
  json::NodeId list_;
  bool usable_ = true;  ///< false: something else than a list of names, which stays as it is
  std::vector<Entry> entries_;
};

}  // namespace gltfx::edit
