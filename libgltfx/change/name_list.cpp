// SPDX-License-Identifier: Apache-2.0
#include "change/name_list.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "json/writer.hpp"

namespace gltfx::change {
NameList::NameList(const json::Document& document, std::string_view member)
    : document_(document), member_(member), list_(document.find(document.root(), member)) {
  if (list_ == json::kNoNode) return;
  usable_ = document.kind(list_) == json::Kind::array;
  if (!usable_) return;
  for (const json::NodeId node : document.elements(list_)) {
    if (document.is_string(node)) ++count_of(document.string(node));
  }
}

std::int64_t NameList::count(std::string_view name) const {
  const json::KeyId id = names_.find(name);
  return id == json::kNoKey ? 0 : counts_[id];
}

std::int64_t& NameList::count_of(std::string_view name) {
  json::KeyId id = names_.find(name);
  if (id == json::kNoKey) id = names_.intern_copy(std::string(name));
  if (id == counts_.size()) counts_.push_back(0);
  return counts_[id];
}

std::string NameList::text_of(json::NodeId node) const {
  const auto changed = texts_.find(node);
  if (changed != texts_.end()) return changed->second;
  return document_.is_string(node) ? document_.string(node) : std::string();
}

std::vector<std::string> NameList::places(std::string_view name) const {
  std::vector<std::string> found;
  if (!usable_ || !names_.contains(name)) return found;
  std::uint64_t index = 0;
  for (const json::NodeId node : document_.elements(list_)) {
    const bool here = document_.is_string(node) && document_.string(node) == name;
    if (here) found.push_back(fmt::format("/{}/{}", member_, index));
    ++index;
  }
  return found;
}

void NameList::change(json::NodeId node, std::string_view from, std::string_view to) {
  --count_of(from);
  if (!to.empty()) ++count_of(to);
  texts_[node] = to;
}

void NameList::replace(std::string_view from, std::string_view to) {
  if (!has(from) || from == to) return;
  if (list_ != json::kNoNode) {
    for (const json::NodeId node : document_.elements(list_)) {
      if (text_of(node) == from) change(node, from, has(to) ? std::string_view() : to);
    }
  }
  if (std::erase(added_, from) == 0) return;
  --count_of(from);
  if (!to.empty()) add(to);
}

void NameList::remove(std::string_view name) { replace(name, {}); }

void NameList::remove_at(json::NodeId node) {
  const std::string name = text_of(node);
  if (has(name)) change(node, name, {});
}

std::set<std::string> NameList::remove_all(const std::map<std::string, json::NodeId>& names) {
  std::set<std::string> removed;
  for (const auto& [name, node] : names) {
    if (has(name)) removed.insert(name);
  }
  std::erase_if(added_, [&](const std::string& name) {
    if (removed.count(name) == 0) return false;
    --count_of(name);
    return true;
  });
  if (removed.empty() || list_ == json::kNoNode) return removed;
  for (const json::NodeId node : document_.elements(list_)) {
    const std::string name = text_of(node);
    if (removed.count(name) != 0) change(node, name, {});
  }
  return removed;
}

void NameList::add(std::string_view name) {
  if (has(name)) return;
  ++count_of(name);
  added_.emplace_back(name);
}

void NameList::apply(json::Editor& editor) const {
  if (!usable_) return;
  if (list_ == json::kNoNode) {
    std::string names;
    for (const std::string& name : added_) {
      names.append(1, names.empty() ? '[' : ',').append(json::string_value(name));
    }
    if (!names.empty()) editor.append_member(document_.root(), member_, names.append(1, ']'));
    return;
  }
  const auto removed = std::count_if(texts_.begin(), texts_.end(),
                                     [](const auto& changed) { return changed.second.empty(); });
  const auto size = static_cast<std::ptrdiff_t>(document_.array_size(list_));
  if (added_.empty() && size > 0 && removed == size)
    return editor.remove(document_.root(), list_ - 1);
  for (const auto& [node, text] : texts_) {
    if (text.empty()) {
      editor.remove(list_, node);
    } else if (text != document_.string(node)) {
      editor.replace_scalar(node, json::string_value(text));
    }
  }
  for (const std::string& name : added_) editor.append_element(list_, json::string_value(name));
}

}  // namespace gltfx::change
