// SPDX-License-Identifier: Apache-2.0
#include "change/lost_content.hpp"

#include <algorithm>
#include <iterator>

#include "base/text.hpp"
#include "graph/extensions.hpp"

namespace gltfx::change {
namespace {

constexpr std::string_view kExtras = "extras";
constexpr std::string_view kExtensions = "extensions";

void add(std::vector<std::string>& names, std::string name) {
  if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(std::move(name));
}

// Whether a value is extras with content.
bool holds_something(const json::Document& document, json::NodeId value) {
  return !document.is_object(value) || document.object_size(value) > 0;
}

// Collects extras, and unknown extensions, in the values of an object's own members.
void look_below(const json::Document& document, const schema::Set& set, json::NodeId value,
                std::vector<std::string>& found) {
  const json::KeyId extras = document.key_id(kExtras);
  const json::NodeId end = document.next(value);
  for (json::NodeId id = value; id < end; ++id) {
    const json::Node& node = document.node(id);
    const bool is_extras = node.kind == json::Kind::key && node.next == extras;
    if (is_extras && holds_something(document, id + 1)) add(found, std::string(kExtras));
  }
  graph::each_extension(document, value, end, [&](const auto& member) {
    const std::string_view name = document.key(member.key_id);
    if (set.find_extension(name) == schema::kNone) add(found, quoted(name));
  });
}

}  // namespace

std::vector<std::string> foreign_members(const json::Document& document, const schema::Set& set,
                                         json::NodeId object, schema::TypeId type) {
  std::vector<std::string> found;
  if (!document.is_object(object)) return found;
  for (const auto member : document.members(object)) {
    const std::string_view name = document.key(member.key_id);
    if (name == kExtras) {
      if (holds_something(document, member.value)) add(found, std::string(kExtras));
    } else if (name == kExtensions && document.is_object(member.value)) {
      for (const auto other : document.members(member.value)) {
        add(found, quoted(document.key(other.key_id)));
      }
    } else if (type != schema::kNone && set.find_property(type, name) == nullptr) {
      add(found, quoted(name));
    }
  }
  return found;
}

std::vector<std::string> foreign_below(const json::Document& document, const schema::Set& set,
                                       json::NodeId value) {
  std::vector<std::string> found;
  look_below(document, set, value, found);
  return found;
}

std::vector<std::string> foreign_content(const json::Document& document, const schema::Set& set,
                                         json::NodeId object, schema::TypeId type) {
  std::vector<std::string> found = foreign_members(document, set, object, type);
  if (!document.is_object(object)) return found;
  for (const auto member : document.members(object)) {
    const std::string_view name = document.key(member.key_id);
    if (name != kExtras && name != kExtensions) look_below(document, set, member.value, found);
  }
  return found;
}

std::map<std::string, json::NodeId> extensions_taken_out(const json::Document& document,
                                                         std::vector<json::NodeId> values) {
  std::sort(values.begin(), values.end());
  std::vector<json::NodeId> outermost;
  for (const json::NodeId value : values) {
    const bool inside = !outermost.empty() && value < document.next(outermost.back());
    if (!inside) outermost.push_back(value);
  }
  std::map<std::string, json::NodeId> found;
  for (const json::NodeId value : outermost) {
    const bool member = value > 0 && document.kind(value - 1) == json::Kind::key;
    graph::each_extension(
        document, member ? value - 1 : value, document.next(value),
        [&](const auto& object) { found.emplace(document.key(object.key_id), value); });
  }
  if (found.empty()) return found;
  graph::each_extension(document, [&](const auto& member) {
    const auto after = std::upper_bound(outermost.begin(), outermost.end(), member.value);
    const bool out = after != outermost.begin() && member.value < document.next(*std::prev(after));
    if (!out) found.erase(std::string(document.key(member.key_id)));
  });
  return found;
}

}  // namespace gltfx::change
