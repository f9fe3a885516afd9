// SPDX-License-Identifier: Apache-2.0
#include "steps/merged_buffers.hpp"

#include <algorithm>
#include <string_view>

#include <fmt/format.h>

#include "base/text.hpp"
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

}  // namespace gltfx::steps
