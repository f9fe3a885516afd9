// SPDX-License-Identifier: Apache-2.0
#include "steps/json_edits.hpp"

#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "change/name_list.hpp"

namespace gltfx::steps {

unsigned target_number(model::ViewTarget target) {
  return target == model::ViewTarget::vertices ? 34962 : 34963;
}

std::string view_json(const NewView& view) {
  std::string json = fmt::format(R"({{"buffer":{},"byteOffset":{},"byteLength":{})", view.buffer,
                                 view.offset, view.length);
  if (view.stride > 0) json += fmt::format(R"(,"byteStride":{})", view.stride);
  if (view.target != model::ViewTarget::none) {
    json += fmt::format(R"(,"target":{})", target_number(view.target));
  }
  return json.append(1, '}');
}

std::vector<std::string_view> free_members(const json::Document& document, json::NodeId view) {
  constexpr std::array<std::string_view, 5> kOfBytes{"buffer", "byteOffset", "byteLength",
                                                     "byteStride", "target"};
  std::vector<std::string_view> names;
  for (const auto member : document.members(view)) {
    const std::string_view name = document.key(member.key_id);
    const bool is_free = std::find(kOfBytes.begin(), kOfBytes.end(), name) == kOfBytes.end();
    if (is_free) names.push_back(name);
  }
  return names;
}

void set_number(const json::Document& document, json::Editor& editor, json::NodeId object,
                std::string_view name, std::uint64_t value) {
  const json::NodeId old = document.find(object, name);
  if (old == json::kNoNode) {
    editor.append_member(object, name, std::to_string(value));
  } else {
    editor.replace(object, old, std::to_string(value));
  }
}

void remove_member(const json::Document& document, json::Editor& editor, json::NodeId object,
                   std::string_view name) {
  const json::NodeId value = document.find(object, name);
  if (value != json::kNoNode) editor.remove(object, value - 1);
}

void add_extension(const json::Document& document, json::Editor& editor, json::NodeId host,
                   std::string_view name, std::string_view json) {
  const json::NodeId extensions = document.find(host, "extensions");
  if (extensions != json::kNoNode) {
    editor.append_member(extensions, name, json);
  } else {
    editor.append_member(host, "extensions", fmt::format(R"({{"{}":{}}})", name, json));
  }
}

void remove_extension(const json::Document& document, json::Editor& editor, json::NodeId host,
                      std::string_view name) {
  const json::NodeId extensions = document.find(host, "extensions");
  const json::NodeId object = document.find(extensions, name);
  if (object == json::kNoNode) return;
  if (document.object_size(extensions) == 1) {
    editor.remove(host, extensions - 1);
  } else {
    editor.remove(extensions, object - 1);
  }
}

std::optional<Error> require_extension(const json::Document& document, json::Editor& editor,
                                       std::string_view name) {
  std::array lists{change::NameList(document, "extensionsUsed"),
                   change::NameList(document, "extensionsRequired")};
  for (change::NameList& list : lists) {
    if (!list.can_change()) {
      return Error{"extensionsUsed or extensionsRequired is not a list of names"};
    }
    list.add(name);
  }
  for (const change::NameList& list : lists) list.apply(editor);
  return std::nullopt;
}

}  // namespace gltfx::steps
