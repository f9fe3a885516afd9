// SPDX-License-Identifier: Apache-2.0
#include "steps/upgrade/placements.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "base/number.hpp"
#include "json/writer.hpp"

namespace gltfx::upgrade {

namespace {

// Numbers may have different spellings. `json` is a JSON value, or empty.
bool is_same(const json::Document& document, json::NodeId old, const std::string& json) {
  if (document.raw(old) == json) return true;
  if (!document.is_number(old)) return false;
  double value = 0;
  const auto read = read_double(json.data(), json.data() + json.size(), value);
  return read.ec == std::errc() && value == document.number(old).value;
}

}  // namespace

std::optional<std::string> Placements::put(std::string_view path, std::string json) {
  std::vector<std::string> object = split_path(path);
  const std::string name = std::move(object.back());
  object.pop_back();
  if (auto problem = check(object)) return problem;
  const json::NodeId found = find_path(context_.document, host_.node, object);
  const json::NodeId old = found == json::kNoNode ? found : context_.document.find(found, name);
  const bool known =
      std::find(overwritten_.begin(), overwritten_.end(), path) != overwritten_.end();
  if (old != json::kNoNode && !known && !is_same(context_.document, old, json)) {
    overwritten_.emplace_back(path);
    taken_out_.push_back(old);
  }
  members_[std::move(object)][name] = std::move(json);
  return std::nullopt;
}

// Requires that the parent of the member is an object: the host, or one of its members.
std::optional<std::string> Placements::check(const std::vector<std::string>& path) {
  json::NodeId at = host_.node;
  for (const std::string& name : path) {
    at = context_.document.find(at, name);
    if (at == json::kNoNode) return std::nullopt;
    if (!context_.document.is_object(at)) return fmt::format("its {} is not an object", name);
  }
  return std::nullopt;
}

std::vector<std::string> Placements::extensions() const {
  std::vector<std::string> names;
  for (const auto& [path, members] : members_) {
    const bool extension = path.size() == 2 && path[0] == "extensions";
    if (extension && find_path(context_.document, host_.node, path) == json::kNoNode) {
      names.push_back(path[1]);
    }
  }
  return names;
}

void Placements::apply() const {
  for (const auto& [path, members] : members_) {
    const json::NodeId object = find_path(context_.document, host_.node, path);
    if (object == json::kNoNode) {
      append(path, members);
    } else {
      apply_to(object, members);
    }
  }
  for (const std::string& name : extensions()) {
    context_.given.emplace(std::pair(host_.node, context_.interned(name)), json::kNoNode);
  }
}

void Placements::apply_to(json::NodeId object, const Members& members) const {
  for (const auto& [name, json] : members) {
    const json::NodeId old = context_.document.find(object, name);
    if (old == json::kNoNode) {
      if (!json.empty()) context_.editor.append_member(object, name, json);
    } else if (json.empty()) {
      context_.editor.remove(object, old - 1);
    } else if (!is_same(context_.document, old, json)) {
      context_.editor.replace(object, old, json);
    }
  }
}

void Placements::append(const std::vector<std::string>& path, const Members& members) const {
  std::string json;
  json::Writer writer(json);
  writer.begin_object();
  for (const auto& [name, value] : members) {
    if (value.empty()) continue;
    writer.key(name);
    writer.raw(value);
  }
  writer.end_object();
  const std::span<const std::string> above(path.data(), path.size() - 1);
  const json::NodeId object = find_path(context_.document, host_.node, above);
  context_.editor.append_member(object, path.back(), json);
}

}  // namespace gltfx::upgrade
