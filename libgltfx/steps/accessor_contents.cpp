// SPDX-License-Identifier: Apache-2.0
#include "steps/accessor_contents.hpp"

#include <algorithm>
#include <string_view>
#include <utility>

#include "steps/accessor_bounds.hpp"
#include "steps/json_edits.hpp"
#include "steps/storage.hpp"

namespace gltfx::steps {
namespace {

using model::Accessor;
using model::BufferView;

std::uint64_t stride_of(const BufferView& view, const Accessor& accessor) {
  return view.byte_stride.value_or(model::packed_stride(accessor.format));
}

}  // namespace

AccessorContents::AccessorContents(const model::OpenedAsset& asset, const graph::Graph& graph,
                                   const model::ResourceData& resources, NewBuffer& buffer,
                                   change::Additions& additions, json::Editor& editor)
    : document_(asset.document()),
      views_(asset.views()),
      graph_(graph),
      resources_(resources),
      buffer_(buffer),
      additions_(additions),
      editor_(editor) {
  for (std::uint32_t i = 0; i < views_.accessors.size(); ++i) {
    if (views_.accessors[i].buffer_view) accessors_[*views_.accessors[i].buffer_view].push_back(i);
  }
}

void AccessorContents::set(std::uint32_t accessor, NewElements elements) {
  set_[accessor] = std::move(elements);
}

std::uint64_t AccessorContents::count_of(std::uint32_t accessor) const {
  const auto found = set_.find(accessor);
  return found == set_.end() ? views_.accessors[accessor].count.value_or(0) : found->second.count;
}

std::optional<Error> AccessorContents::store() {
  std::map<std::uint32_t, std::vector<std::uint32_t>> by_view;
  for (const auto& [accessor, elements] : set_) {
    by_view[*views_.accessors[accessor].buffer_view].push_back(accessor);
  }
  for (const auto& [view, accessors] : by_view) {
    if (const auto blocks = blocks_of(view)) {
      if (auto trouble = store_view(view, *blocks)) return trouble;
      continue;
    }
    for (const std::uint32_t accessor : accessors) store_alone(accessor, set_.at(accessor));
  }
  return std::nullopt;
}

// The blocks of a view, by offset; nothing: the view cannot be replaced as a whole.
std::optional<std::vector<AccessorContents::Block>> AccessorContents::blocks_of(
    std::uint32_t index) const {
  const BufferView& view = views_.buffer_views[index];
  std::vector<std::uint32_t> accessors = accessors_.at(index);
  if (graph_.users(view.node).size() != accessors.size()) return std::nullopt;
  if (document_.find(view.node, "extensions") != json::kNoNode) return std::nullopt;
  const auto offset = [this](std::uint32_t i) {
    return views_.accessors[i].byte_offset.value_or(0);
  };
  std::stable_sort(accessors.begin(), accessors.end(),
                   [&](std::uint32_t a, std::uint32_t b) { return offset(a) < offset(b); });
  std::vector<Block> blocks;
  std::uint64_t end = 0;          // of the last block
  std::uint64_t element_end = 0;  // of the last accessor in the first vertex of its block
  for (const std::uint32_t i : accessors) {
    const Accessor& accessor = views_.accessors[i];
    if (!accessor.format.known() || !accessor.count) return std::nullopt;
    const bool interleaved =
        view.byte_stride && !blocks.empty() && offset(i) < blocks.back().begin + *view.byte_stride;
    const auto size = accessor.span_size(stride_of(view, accessor));
    if (!size || !resources_.part(document_, view, offset(i), *size)) return std::nullopt;
    const std::uint64_t own_end = offset(i) + model::element_size(accessor.format);
    if (!interleaved) {
      if (offset(i) < end) return std::nullopt;
      blocks.push_back({offset(i), {}});
    } else if (offset(i) < element_end ||
               count_of(i) != count_of(blocks.back().accessors.front())) {
      return std::nullopt;
    }
    if (own_end > blocks.back().begin + stride_of(view, accessor)) return std::nullopt;
    blocks.back().accessors.push_back(i);
    element_end = own_end;
    end = std::max(end, offset(i) + *size);
  }
  return blocks;
}

std::optional<Error> AccessorContents::store_view(std::uint32_t index,
                                                  const std::vector<Block>& blocks) {
  const BufferView& view = views_.buffer_views[index];
  std::string bytes;
  for (const Block& block : blocks) {
    const std::uint64_t begin = aligned(bytes.size());
    const std::uint64_t stride = stride_of(view, views_.accessors[block.accessors.front()]);
    bytes.resize(begin + stride * count_of(block.accessors.front()));
    for (const std::uint32_t i : block.accessors) {
      const Accessor& accessor = views_.accessors[i];
      const std::uint64_t size = model::element_size(accessor.format);
      const std::uint64_t offset = accessor.byte_offset.value_or(0) - block.begin;
      const auto found = set_.find(i);
      container::Bytes old;
      std::string_view from;
      std::uint64_t distance = model::packed_stride(accessor.format);
      if (found != set_.end()) {
        from = found->second.bytes;
      } else {
        auto part = resources_.part(document_, view, accessor.byte_offset.value_or(0),
                                    *accessor.span_size(stride));
        if (!part) return Error{"the bytes of an accessor are missing"};
        old = *std::move(part);
        from = old.text();
        distance = stride;
      }
      for (std::uint64_t at = 0; at < count_of(i); ++at) {
        from.substr(at * distance, size).copy(bytes.data() + begin + offset + at * stride, size);
      }
      declare(i, begin + offset);
    }
  }
  set_number(document_, editor_, view.node, "byteLength", bytes.size());
  set_number(document_, editor_, view.node, "buffer", buffer_.index());
  set_number(document_, editor_, view.node, "byteOffset", buffer_.add(std::move(bytes)));
  return std::nullopt;
}

void AccessorContents::store_alone(std::uint32_t index, const NewElements& elements) {
  const Accessor& accessor = views_.accessors[index];
  const BufferView& old = views_.buffer_views[*accessor.buffer_view];
  const std::uint64_t size = model::packed_stride(accessor.format);
  const bool of_vertices = old.target == model::ViewTarget::vertices || old.byte_stride;
  const std::uint64_t stride = of_vertices ? aligned(size, kVertexAlignment) : size;
  std::string bytes = elements.bytes;
  if (stride != size) {
    bytes.assign(stride * elements.count, '\0');
    for (std::uint64_t i = 0; i < elements.count; ++i) {
      elements.bytes.copy(bytes.data() + i * stride, size, i * size);
    }
  }
  const std::size_t length = bytes.size();
  const std::uint64_t offset = buffer_.add(std::move(bytes));
  const std::uint64_t view = additions_.add_element(
      "bufferViews",
      view_json({buffer_.index(), offset, length, of_vertices ? stride : 0, old.target}));
  set_number(document_, editor_, accessor.node, "bufferView", view);
  declare(index, 0);
}

void AccessorContents::declare(std::uint32_t index, std::uint64_t offset) {
  const Accessor& accessor = views_.accessors[index];
  if (offset != accessor.byte_offset.value_or(0))
    set_number(document_, editor_, accessor.node, "byteOffset", offset);
  const auto found = set_.find(index);
  if (found == set_.end()) return;
  if (found->second.count != accessor.count)
    set_number(document_, editor_, accessor.node, "count", found->second.count);
  if (found->second.other_values) mend_bounds(document_, editor_, accessor, found->second.bytes);
}

}  // namespace gltfx::steps
