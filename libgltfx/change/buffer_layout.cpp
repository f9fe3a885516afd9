// SPDX-License-Identifier: Apache-2.0
#include "change/buffer_layout.hpp"

#include <optional>
#include <string>
#include <unordered_set>

#include <fmt/format.h>

#include "base/checked.hpp"
#include "base/text.hpp"
#include "container/base64.hpp"
#include "container/uri.hpp"
#include "model/fields.hpp"
#include "model/resource_data.hpp"

namespace gltfx::change {
namespace {

// Nothing if the members do not define a range.
std::optional<ByteRange> bytes_of(const graph::Graph& graph, json::NodeId object) {
  const json::Document& document = graph.tree().document();
  const schema::TypeId type = graph.type(object);
  if (type == schema::kNone || graph.set().find_property(type, "byteOffset") == nullptr) {
    return std::nullopt;
  }
  const auto begin =
      model::start_of(document, object, model::unsigned_member(document, object, "byteOffset"));
  const auto length = model::unsigned_member(document, object, "byteLength");
  const Checked end = begin && length ? checked_add(*begin, *length) : std::nullopt;
  if (!end || *length == 0) return std::nullopt;
  return ByteRange{*begin, *end};
}

}  // namespace

Result<std::vector<BufferUser>> buffer_users(const graph::Graph& graph) {
  const graph::Tree& tree = graph.tree();
  const json::NodeId root = tree.document().root();
  const json::NodeId buffers = tree.member(root, "buffers");
  const auto unclear = [&](json::NodeId object) {
    return Error{
        fmt::format("{} does not define which bytes it uses", printable(tree.pointer(object)))};
  };
  std::vector<BufferUser> users;
  std::unordered_set<json::NodeId> known;
  for (const graph::IndexUse& use : graph.indices()) {
    if (use.array != "/buffers" && (use.list != buffers || buffers == json::kNoNode)) continue;
    const json::NodeId object = use.at.element ? use.at.node : tree.parent(use.at.node);
    const auto bytes = use.at.element ? std::nullopt : bytes_of(graph, object);
    const bool leads_somewhere =
        use.list == buffers && buffers != json::kNoNode && use.index < tree.size(use.list);
    if (!bytes || !leads_somewhere) return unclear(object);
    users.push_back({object, use.index, *bytes});
    known.insert(object);
  }
  const json::NodeId views = tree.member(root, "bufferViews");
  const std::uint64_t count = views == json::kNoNode ? 0 : tree.size(views);
  for (std::uint64_t i = 0; i < count; ++i) {
    const json::NodeId view = tree.element(views, i);
    if (view == json::kNoNode) return unclear(views);
    if (!known.contains(view)) return unclear(view);
  }
  return users;
}

void move_user(const json::Document& document, const BufferUser& user, std::uint64_t begin,
               json::Editor& editor) {
  if (begin == user.bytes.begin) return;
  const json::NodeId offset = document.find(user.object, "byteOffset");
  if (offset == json::kNoNode) {
    editor.append_member(user.object, "byteOffset", std::to_string(begin));
  } else {
    editor.replace_scalar(offset, std::to_string(begin));
  }
}

Result<std::string> with_data(std::string_view uri, std::string_view bytes) {
  const auto split = container::split_data_uri(uri);
  if (!split) return split.error();
  std::string text(uri.substr(0, uri.find(',')));
  if (!split->base64) text += ";base64";
  return text.append(1, ',').append(container::encode_base64(bytes));
}

}  // namespace gltfx::change
