// SPDX-License-Identifier: Apache-2.0
#include "model/buffer_view.hpp"

namespace gltfx::model {
namespace {

std::optional<std::uint64_t> in_range(std::optional<std::uint64_t> value, std::uint64_t least,
                                      std::uint64_t most) {
  return value && *value >= least && *value <= most ? value : std::nullopt;
}

ViewTarget read_target(const json::Document& document, json::NodeId value) {
  const auto number = document.unsigned_integer(value);
  if (number == 34962U) return ViewTarget::vertices;
  return number == 34963U ? ViewTarget::indices : ViewTarget::none;
}

}  // namespace

BufferView read_buffer_view(const Asset& asset, json::NodeId object) {
  BufferView view;
  view.node = object;
  if (object == json::kNoNode) return view;
  const json::Document& document = asset.document();
  for (const auto member : document.members(object)) {
    const std::string_view name = document.key(member.key_id);
    if (name == "buffer") {
      const bool number = document.is_number(member.value);
      view.buffer = number ? asset.index(document.number(member.value).value, RootArray::buffers)
                           : std::nullopt;
    } else if (name == "byteOffset") {
      view.byte_offset = document.unsigned_integer(member.value);
    } else if (name == "byteLength") {
      view.byte_length = in_range(document.unsigned_integer(member.value), 1, UINT64_MAX);
    } else if (name == "byteStride") {
      view.byte_stride = in_range(document.unsigned_integer(member.value), 4, 252);
    } else if (name == "target") {
      view.target = read_target(document, member.value);
    }
  }
  return view;
}

std::vector<BufferView> read_buffer_views(const Asset& asset) {
  std::vector<BufferView> views;
  views.reserve(asset.count(RootArray::buffer_views));
  for (const json::NodeId object : asset.elements(RootArray::buffer_views)) {
    views.push_back(read_buffer_view(asset, object));
  }
  return views;
}

}  // namespace gltfx::model
