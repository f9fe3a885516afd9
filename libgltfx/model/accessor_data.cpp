// SPDX-License-Identifier: Apache-2.0
#include "model/accessor_data.hpp"

#include <cstring>
#include <utility>

#include "base/checked.hpp"
#include "model/fields.hpp"

namespace gltfx::model {
namespace {

template <typename T>
T load(const std::byte* from) {
  T value;
  std::memcpy(&value, from, sizeof(T));
  return value;
}

// Copies `count` pieces of a size that is known to the compiler.
template <std::size_t Size>
void copy_pieces(std::byte* to, const std::byte* from, std::size_t count, std::uint64_t stride) {
  for (std::size_t i = 0; i < count; ++i) {
    std::memcpy(to + i * Size, from + i * stride, Size);
  }
}

struct Range {
  std::uint64_t offset;
  std::uint64_t component_size;
  Checked length;
};

// A part of a view whose numbers are aligned, also relative to the start of the buffer.
std::optional<container::Bytes> aligned_part(const Asset& asset, const BufferView& view,
                                             const ResourceData& resources, const Range& range) {
  const auto start = start_of(asset.document(), view.node, view.byte_offset);
  if (!start || !range.length || range.offset % range.component_size != 0) return std::nullopt;
  const Checked total = checked_add(*start, range.offset);
  if (!total || *total % range.component_size != 0) return std::nullopt;
  return resources.part(asset.document(), view, range.offset, *range.length);
}

bool is_complete(const Asset& asset, const Accessor& accessor) {
  const json::Document& document = asset.document();
  const json::NodeId count = document.find(accessor.sparse, "count");
  const auto number = count == json::kNoNode ? std::nullopt : document.unsigned_integer(count);
  return number && *number > 0 &&
         object_member(document, accessor.sparse, "indices") != json::kNoNode &&
         object_member(document, accessor.sparse, "values") != json::kNoNode;
}

bool has_member(const Asset& asset, json::NodeId object, std::string_view name) {
  return asset.document().find(object, name) != json::kNoNode;
}

}  // namespace

std::uint32_t PackedNumbers::index(std::uint64_t at) const {
  const std::byte* first = bytes.view().data();
  if (type == ComponentType::uint8) return load<std::uint8_t>(first + at);
  if (type == ComponentType::uint16) return load<std::uint16_t>(first + at * 2);
  return load<std::uint32_t>(first + at * 4);
}

std::optional<PackedNumbers> sparse_indices(const Asset& asset, const Views& views,
                                            const ResourceData& resources, const Sparse& sparse) {
  const SparsePart& part = sparse.indices;
  const auto offset = start_of(asset.document(), part.node, part.byte_offset);
  if (!part.buffer_view || !offset || !can_index_elements(part.format.component))
    return std::nullopt;
  const unsigned size = component_size(part.format.component);
  // As a view of any length: whether the indices are inside it is a separate check.
  BufferView view = views.buffer_views[*part.buffer_view];
  view.byte_length = UINT64_MAX;
  const Range range{*offset, size, checked_mul(*sparse.count, size)};
  auto bytes = aligned_part(asset, view, resources, range);
  if (!bytes) return std::nullopt;
  return PackedNumbers{*std::move(bytes), part.format.component};
}

bool AccessorData::open_base(const Asset& asset, const Views& views, const ResourceData& resources,
                             const Accessor& accessor, Malformed malformed) {
  if (!accessor.buffer_view) {
    return malformed == Malformed::absent || !has_member(asset, accessor.node, "bufferView");
  }
  const BufferView& view = views.buffer_views[*accessor.buffer_view];
  const bool bad_stride = !view.byte_stride && has_member(asset, view.node, "byteStride");
  if (bad_stride && malformed == Malformed::unusable) return false;
  stride_ = view.byte_stride.value_or(packed_stride(format_));
  const auto offset = start_of(asset.document(), accessor.node, accessor.byte_offset);
  if (!offset || stride_ < element_size(format_)) return false;
  const Range range{*offset, component_size_, accessor.span_size(stride_)};
  if (stride_ % component_size_ != 0) {
    if (malformed == Malformed::unusable) return false;
    stride_ -= stride_ % component_size_;  // only whole components count
  }
  auto bytes = aligned_part(asset, view, resources, range);
  if (!bytes) return false;
  base_ = *std::move(bytes);
  return true;
}

bool AccessorData::open_sparse(const Asset& asset, const Views& views,
                               const ResourceData& resources, const Accessor& accessor,
                               Malformed malformed) {
  if (malformed == Malformed::absent && !is_complete(asset, accessor)) return true;
  const auto sparse = read_sparse(asset, accessor);
  if (!sparse || *sparse->count > count_) return false;
  const SparsePart& values = sparse->values;
  const auto offset = start_of(asset.document(), values.node, values.byte_offset);
  auto indices = sparse_indices(asset, views, resources, *sparse);
  if (!indices || !offset || !values.buffer_view) return false;
  const BufferView& index_view = views.buffer_views[*sparse->indices.buffer_view];
  const auto index_offset =
      start_of(asset.document(), sparse->indices.node, sparse->indices.byte_offset);
  if (!index_view.byte_length ||
      !fits(*index_offset, indices->bytes.size(), *index_view.byte_length)) {
    return false;
  }
  const Checked length = checked_mul(*sparse->count, std::uint64_t{component_size_} * components_);
  auto bytes = aligned_part(asset, views.buffer_views[*values.buffer_view], resources,
                            {*offset, component_size_, length});
  if (!bytes) return false;
  sparse_count_ = *sparse->count;
  sparse_indices_ = *std::move(indices);
  sparse_values_ = *std::move(bytes);
  return true;
}

std::optional<AccessorData> AccessorData::open(const Asset& asset, const Views& views,
                                               const ResourceData& resources,
                                               const Accessor& accessor, Malformed malformed) {
  if (!accessor.count || !accessor.format.known()) return std::nullopt;
  if (!is_core_component(accessor.format.component)) return std::nullopt;
  AccessorData data;
  data.format_ = accessor.format;
  data.count_ = *accessor.count;
  data.components_ = component_count(accessor.format.type);
  data.component_size_ = component_size(accessor.format.component);
  const bool padded =
      packed_stride(accessor.format) != std::uint64_t{data.components_} * data.component_size_;
  data.rows_ = !padded ? data.components_ : accessor.format.type == ElementType::mat2 ? 2 : 3;
  data.column_stride_ = packed_stride(accessor.format) / (data.components_ / data.rows_);
  if (!data.open_base(asset, views, resources, accessor, malformed)) return std::nullopt;
  if (accessor.sparse != json::kNoNode &&
      !data.open_sparse(asset, views, resources, accessor, malformed)) {
    return std::nullopt;
  }
  if (data.implied() && data.sparse_count_ == 0) return std::nullopt;
  return data;
}

std::optional<AccessorData> AccessorData::packed(const Format& format, std::uint64_t count,
                                                 container::Bytes bytes, double step) {
  if (count == 0 || !format.known() || !is_core_component(format.component)) return std::nullopt;
  AccessorData data;
  data.format_ = format;
  data.count_ = count;
  data.components_ = component_count(format.type);
  data.component_size_ = component_size(format.component);
  data.rows_ = data.components_;
  data.stride_ = std::uint64_t{data.components_} * data.component_size_;
  const Checked size = checked_mul(count, data.stride_);
  if (!size || *size > bytes.size()) return std::nullopt;
  data.base_ = std::move(bytes);
  data.step_ = step;
  return data;
}

void AccessorData::copy(std::byte* to, std::uint64_t first, std::size_t count) const {
  const std::size_t size = std::size_t{component_size_} * components_;
  if (implied()) {
    std::memset(to, 0, count * size);
    return;
  }
  const std::byte* from = base_.view().data() + first * stride_;
  if (rows_ != components_) {
    const std::size_t column = std::size_t{component_size_} * rows_;
    for (std::size_t i = 0; i < count * (components_ / rows_); ++i) {
      const std::size_t columns = components_ / rows_;
      std::memcpy(to + i * column, from + i / columns * stride_ + i % columns * column_stride_,
                  column);
    }
    return;
  }
  switch (size) {
    case 2:
      return copy_pieces<2>(to, from, count, stride_);
    case 4:
      return copy_pieces<4>(to, from, count, stride_);
    case 6:
      return copy_pieces<6>(to, from, count, stride_);
    case 8:
      return copy_pieces<8>(to, from, count, stride_);
    case 12:
      return copy_pieces<12>(to, from, count, stride_);
    case 16:
      return copy_pieces<16>(to, from, count, stride_);
    default:
      for (std::size_t i = 0; i < count; ++i) std::memcpy(to + i * size, from + i * stride_, size);
  }
}

// Sparse indices increase, as for replace(): binary search.
void AccessorData::read_one(std::byte* to, std::uint64_t index) const {
  copy(to, index, 1);
  std::uint64_t first = 0;
  std::uint64_t last = sparse_count_;
  while (first < last) {
    const std::uint64_t middle = first + (last - first) / 2;
    if (sparse_indices_.index(middle) < index) {
      first = middle + 1;
    } else {
      last = middle;
    }
  }
  if (first == sparse_count_ || sparse_indices_.index(first) != index) return;
  const std::size_t size = std::size_t{component_size_} * components_;
  std::memcpy(to, sparse_values_.view().data() + first * size, size);
}

void AccessorData::replace(std::byte* to, std::uint64_t first, std::size_t count,
                           std::uint64_t& next) const {
  const std::size_t size = std::size_t{component_size_} * components_;
  std::uint64_t least = first;
  while (next < sparse_count_) {
    const std::uint64_t index = sparse_indices_.index(next);
    // Indices increase; the first that does not ends the replacement, because readers rely on the
    // order.
    if (index < least || index - first >= count) return;
    std::memcpy(to + (index - first) * size, sparse_values_.view().data() + next * size, size);
    least = index + 1;
    ++next;
  }
}

}  // namespace gltfx::model
