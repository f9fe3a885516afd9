// SPDX-License-Identifier: Apache-2.0
#include "model/resource_data.hpp"

#include "base/checked.hpp"

namespace gltfx::model {

std::optional<std::uint64_t> start_of(const json::Document& document, json::NodeId object,
                                      const std::optional<std::uint64_t>& byte_offset) {
  if (byte_offset) return byte_offset;
  if (document.has_value(object, "byteOffset")) return std::nullopt;
  return 0;
}

std::optional<container::Bytes> ResourceData::part(const json::Document& document,
                                                   const BufferView& view, std::uint64_t offset,
                                                   std::uint64_t length) const {
  if (!view.byte_length || !fits(offset, length, *view.byte_length)) return std::nullopt;
  if (const DecodedView* own = decoded(view)) {
    if (!fits(offset, length, own->bytes.size())) return std::nullopt;
    return own->bytes.part(static_cast<std::size_t>(offset), static_cast<std::size_t>(length));
  }
  if (!view.buffer || *view.buffer >= buffers.size()) return std::nullopt;
  const std::optional<container::Bytes>& bytes = buffers[*view.buffer];
  const auto start = start_of(document, view.node, view.byte_offset);
  if (!bytes || !start) return std::nullopt;
  const Checked begin = checked_add(*start, offset);
  if (!begin || !fits(*begin, length, bytes->size())) return std::nullopt;
  return bytes->part(static_cast<std::size_t>(*begin), static_cast<std::size_t>(length));
}

const DecodedView* ResourceData::decoded(const BufferView& view) const {
  const auto found = decoded_views.find(view.node);
  return found == decoded_views.end() ? nullptr : &found->second;
}

}  // namespace gltfx::model
