// SPDX-License-Identifier: Apache-2.0
#include "steps/merged_buffers.hpp"

#include <algorithm>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "base/text.hpp"
#include "graph/renumber.hpp"
#include "model/fields.hpp"
#include "model/meshopt_view.hpp"

namespace gltfx::steps {

std::string find_overrun(const graph::Graph& graph, const model::AssetBytes& bytes,
                         const std::vector<change::BufferUser>& users) {
  const json::Document& document = graph.tree().document();
  for (const change::BufferUser& user : users) {
    if (bytes.buffer_storage(user.buffer) == model::Storage::nowhere) continue;
    const json::NodeId buffer =
        bytes.asset().elements(model::RootArray::buffers)[static_cast<std::size_t>(user.buffer)];
    const auto declared = model::unsigned_member(document, buffer, "byteLength");
    if (user.bytes.end <= declared.value_or(0)) continue;
    return fmt::format("{} refers to bytes after the end of its buffer",
                       printable(graph.tree().pointer(user.object)));
  }
  return {};
}

bool is_plain_copy(const json::Document& document, json::NodeId buffer) {
  const json::NodeId extensions = document.find(buffer, "extensions");
  return std::any_of(model::kMeshoptExtensions.begin(), model::kMeshoptExtensions.end(),
                     [&](std::string_view name) {
                       return model::true_member(document, document.find(extensions, name),
                                                 "fallback");
                     });
}

std::string find_lost_member(const json::Document& document, json::NodeId buffer) {
  for (const auto member : document.members(buffer)) {
    const std::string_view name = document.key(member.key_id);
    if (name == "uri" || name == "chunk" || name == "byteLength" || name == "name") continue;
    return fmt::format("its {} would be lost in another buffer", gltfx::quoted(name));
  }
  return {};
}

void move_users(const graph::Graph& graph, const std::vector<change::BufferUser>& users,
                const std::vector<Packed>& packed, json::Editor& editor) {
  const graph::Tree& tree = graph.tree();
  const json::Document& document = tree.document();
  const json::NodeId list = document.find(document.root(), "buffers");
  const std::uint64_t count = tree.size(list);
  const std::uint64_t home = packed.front().index;
  std::vector<std::uint64_t> base(count), position(count);
  std::vector<bool> goes(count);
  for (const Packed& each : packed) {
    base[each.index] = each.base;
    goes[each.index] = each.index != home;
  }
  std::uint64_t next = 0;
  for (std::uint64_t i = 0; i < count; ++i) {
    position[i] = goes[i] ? 0 : next++;
    if (goes[i]) editor.remove(list, tree.element(list, i));
  }
  for (std::uint64_t i = 0; i < count; ++i) {
    if (goes[i]) position[i] = position[home];
  }
  for (const change::BufferUser& user : users) {
    change::move_user(document, user, user.bytes.begin + base[user.buffer], editor);
  }
  auto edits = graph::renumber(
      graph,
      [&](json::NodeId array, std::uint64_t index) {
        return array == list ? position[index] : index;
      },
      [](graph::Place) { return false; });
  for (json::Edit& edit : edits) editor.replace_text(edit.span, std::move(edit.text));
}

}  // namespace gltfx::steps
