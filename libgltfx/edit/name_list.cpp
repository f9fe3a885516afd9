// SPDX-License-Identifier: Apache-2.0
#include "edit/name_list.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "json/writer.hpp"

namespace gltfx::edit {
namespace {

std::string json_string(std::string_view text) {
  std::string json;
  json::append_string(json, text);
  return json;
}

}  // namespace

NameList::NameList(const json::Document& document, std::string_view member)
    : document_(document), member_(member), list_(document.find(document.root(), member)) {
  if (list_ == json::kNoNode) return;
  usable_ = document.kind(list_) == json::Kind::array;
  if (!usable_) return;
  for (const json::NodeId node : document.elements(list_)) {
    const std::string name = document.is_string(node) ? document.string(node) : std::string();
    entries_.push_back({node, name, name});
  }
}

bool NameList::has(std::string_view name) const {
  return std::any_of(entries_.begin(), entries_.end(),
                     [&](const Entry& entry) { return entry.is == name; });
}

std::vector<std::string> NameList::places(std::string_view name) const {
  std::vector<std::string> found;
  for (std::size_t i = 0; i < entries_.size(); ++i) {
    const bool old = entries_[i].node != json::kNoNode;
    if (old && entries_[i].was == name) found.push_back(fmt::format("/{}/{}", member_, i));
  }
  return found;
}

void NameList::replace(std::string_view from, std::string_view to) {
  for (Entry& entry : entries_) {
    if (entry.is != from) continue;
    entry.is = has(to) ? std::string_view() : to;
  }
}

void NameList::remove(std::string_view name) {
  for (Entry& entry : entries_) {
    if (entry.is == name) entry.is.clear();
  }
}

std::set<std::string> NameList::remove_all(const std::map<std::string, json::NodeId>& names) {
  std::set<std::string> removed;
  for (Entry& entry : entries_) {
    if (names.count(entry.is) == 0) continue;
    removed.insert(entry.is);
    entry.is.clear();
  }
  return removed;
}

void NameList::add(std::string_view name) {
  if (!has(name)) entries_.push_back({json::kNoNode, {}, std::string(name)});
}

void NameList::apply(json::Editor& editor) const {
  if (!usable_) return;
  const auto stays = [](const Entry& entry) { return !entry.is.empty() || entry.was == entry.is; };
  const bool empty = std::none_of(entries_.begin(), entries_.end(), stays);
  if (list_ == json::kNoNode) {
    std::string names;
    for (const Entry& entry : entries_) {
      names.append(1, names.empty() ? '[' : ',').append(json_string(entry.is));
    }
    if (!empty) editor.append_member(document_.root(), member_, names.append(1, ']'));
    return;
  }
  if (empty && !entries_.empty()) return editor.remove(document_.root(), list_ - 1);
  for (const Entry& entry : entries_) {
    if (entry.node == json::kNoNode) {
      editor.append_element(list_, json_string(entry.is));
    } else if (entry.is != entry.was && entry.is.empty()) {
      editor.remove(list_, entry.node);
    } else if (entry.is != entry.was) {
      editor.replace_scalar(entry.node, json_string(entry.is));
    }
  }
}

}  // namespace gltfx::edit
