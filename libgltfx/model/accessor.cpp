// SPDX-License-Identifier: Apache-2.0
#include "model/accessor.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "base/checked.hpp"
#include "model/fields.hpp"

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

struct TypeRow {
  std::string_view name;
  std::uint8_t components, columns, rows;
};
constexpr std::array<TypeRow, 8> kTypes{{{"", 0, 0, 0},
                                         {"SCALAR", 1, 1, 1},
                                         {"VEC2", 2, 1, 2},
                                         {"VEC3", 3, 1, 3},
                                         {"VEC4", 4, 1, 4},
                                         {"MAT2", 4, 2, 2},
                                         {"MAT3", 9, 3, 3},
                                         {"MAT4", 16, 4, 4}}};

struct ComponentRow {
  ComponentType type;
  std::string_view name;
  std::uint8_t size;
  bool core;
};
constexpr std::array<ComponentRow, 9> kComponents{
    {{ComponentType::int8, "BYTE", 1, true},
     {ComponentType::uint8, "UNSIGNED_BYTE", 1, true},
     {ComponentType::int16, "SHORT", 2, true},
     {ComponentType::uint16, "UNSIGNED_SHORT", 2, true},
     {ComponentType::int32, "INT", 4, false},
     {ComponentType::uint32, "UNSIGNED_INT", 4, true},
     {ComponentType::float32, "FLOAT", 4, true},
     {ComponentType::float64, "DOUBLE", 8, false},
     {ComponentType::float16, "HALF_FLOAT", 2, false}}};

const TypeRow& row(ElementType type) { return kTypes[static_cast<std::size_t>(type)]; }

const ComponentRow* row(ComponentType type) {
  const auto at = std::find_if(kComponents.begin(), kComponents.end(),
                               [&](const ComponentRow& each) { return each.type == type; });
  return at == kComponents.end() ? nullptr : &*at;
}

ComponentType read_component(const json::Document& document, json::NodeId value) {
  const auto number = document.unsigned_integer(value);
  if (!number || *number > UINT16_MAX) return ComponentType::none;
  const auto type = static_cast<ComponentType>(*number);
  return row(type) != nullptr ? type : ComponentType::none;
}

ElementType read_type(const json::Document& document, json::NodeId value) {
  if (!document.is_string(value)) return ElementType::none;
  std::string buffer;
  return element_type_from_name(document.string(value, buffer)).value_or(ElementType::none);
}

std::optional<std::uint64_t> read_count(const json::Document& document, json::NodeId value) {
  const auto count = document.unsigned_integer(value);
  return count && *count >= 1 ? count : std::nullopt;
}

std::optional<std::uint32_t> read_index(const Asset& asset, json::NodeId value, RootArray array) {
  if (!asset.document().is_number(value)) return std::nullopt;
  return asset.index(asset.document().number(value).value, array);
}

std::uint64_t column_stride(const Format& format) {
  const std::uint64_t bytes =
      std::uint64_t{row(format.type).rows} * component_size(format.component);
  return is_matrix(format.type) ? (bytes + 3) / 4 * 4 : bytes;
}

void read_member(const Asset& asset, std::string_view name, json::NodeId value,
                 Accessor& accessor) {
  const json::Document& document = asset.document();
  if (name == "bufferView") {
    accessor.buffer_view = read_index(asset, value, RootArray::buffer_views);
  } else if (name == "byteOffset") {
    accessor.byte_offset = document.unsigned_integer(value);
  } else if (name == "componentType") {
    accessor.format.component = read_component(document, value);
  } else if (name == "normalized") {
    accessor.format.normalized = document.kind(value) == json::Kind::true_value;
  } else if (name == "count") {
    accessor.count = read_count(document, value);
  } else if (name == "type") {
    accessor.format.type = read_type(document, value);
  } else if (name == "min") {
    accessor.min = document.is_array(value) ? value : json::kNoNode;
  } else if (name == "max") {
    accessor.max = document.is_array(value) ? value : json::kNoNode;
  } else if (name == "sparse") {
    accessor.sparse = document.is_object(value) ? value : json::kNoNode;
  }
}

SparsePart read_part(const Asset& asset, json::NodeId sparse, std::string_view member) {
  SparsePart part;
  part.node = object_member(asset.document(), sparse, member);
  part.buffer_view = asset.index(part.node, "bufferView", RootArray::buffer_views);
  part.byte_offset = unsigned_member(asset.document(), part.node, "byteOffset");
  return part;
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

std::string_view element_type_name(ElementType type) { return row(type).name; }

std::optional<ElementType> element_type_from_name(std::string_view name) {
  for (std::size_t i = 1; i < kTypes.size(); ++i) {
    if (kTypes[i].name == name) return static_cast<ElementType>(i);
  }
  return std::nullopt;
}

std::string_view component_type_name(ComponentType type) {
  const ComponentRow* found = row(type);
  return found != nullptr ? found->name : std::string_view();
}

unsigned component_size(ComponentType type) {
  const ComponentRow* found = row(type);
  return found != nullptr ? found->size : 0;
}

bool is_core_component(ComponentType type) {
  const ComponentRow* found = row(type);
  return found != nullptr && found->core;
}

unsigned component_count(ElementType type) { return row(type).components; }

bool is_matrix(ElementType type) { return row(type).columns > 1; }

std::string format_text(const Format& format) {
  const std::string_view type = element_type_name(format.type);
  const std::string_view component = component_type_name(format.component);
  return fmt::format("{} of {}{}", type.empty() ? "an unknown type" : type,
                     format.normalized ? "normalized " : "",
                     component.empty() ? "unknown components" : component);
}

std::uint64_t packed_stride(const Format& format) {
  return format.known() ? column_stride(format) * row(format.type).columns : 0;
}

std::uint64_t element_size(const Format& format) {
  if (!format.known()) return 0;
  const std::uint64_t last =
      std::uint64_t{row(format.type).rows} * component_size(format.component);
  return packed_stride(format) - column_stride(format) + last;
}

ValueRange value_range(ComponentType type) {
  switch (type) {
    case ComponentType::int8:
      return {-128, 127};
    case ComponentType::uint8:
      return {0, 255};
    case ComponentType::int16:
      return {-32768, 32767};
    case ComponentType::uint16:
      return {0, 65535};
    case ComponentType::int32:
      return {-2147483648.0, 2147483647.0};
    case ComponentType::uint32:
      return {0, 4294967295.0};
    default:
      return {-std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
  }
}

bool is_integer(ComponentType type) {
  return component_size(type) > 0 && std::isfinite(value_range(type).most);
}

bool is_sound_bound(const json::Document& document, const Format& format, json::NodeId array) {
  if (array == json::kNoNode || document.kind(array) != json::Kind::number_array) return false;
  const ValueRange range = value_range(format.component);
  unsigned size = 0;
  for (json::NumberCursor at(document, array); at.valid(); at.advance()) {
    if (++size > component_count(format.type)) return false;
    const json::Number& number = at.number();
    if (is_integer(format.component) && !number.is_integer()) return false;
    if (!std::isfinite(number.value) || !range.contains(number.value)) return false;
  }
  return size == component_count(format.type);
}

std::optional<std::uint64_t> Accessor::span_size(std::uint64_t stride) const {
  if (!count || !format.known()) return std::nullopt;
  const auto before_last = checked_mul(*count - 1, stride);
  return before_last ? checked_add(*before_last, element_size(format)) : std::nullopt;
}

Accessor read_accessor(const Asset& asset, json::NodeId object) {
  Accessor accessor;
  accessor.node = object;
  if (object == json::kNoNode) return accessor;
  const json::Document& document = asset.document();
  for (const auto member : document.members(object)) {
    read_member(asset, document.key(member.key_id), member.value, accessor);
  }
  return accessor;
}

std::vector<Accessor> read_accessors(const Asset& asset) {
  std::vector<Accessor> accessors;
  accessors.reserve(asset.count(RootArray::accessors));
  for (const json::NodeId object : asset.elements(RootArray::accessors)) {
    accessors.push_back(read_accessor(asset, object));
  }
  return accessors;
}

bool can_index_elements(ComponentType type) {
  return type == ComponentType::uint8 || type == ComponentType::uint16 ||
         type == ComponentType::uint32;
}

std::optional<Sparse> read_sparse(const Asset& asset, const Accessor& accessor) {
  if (accessor.sparse == json::kNoNode) return std::nullopt;
  const json::Document& document = asset.document();
  Sparse sparse;
  const json::NodeId count = document.find(accessor.sparse, "count");
  if (count != json::kNoNode) sparse.count = read_count(document, count);
  sparse.indices = read_part(asset, accessor.sparse, "indices");
  sparse.values = read_part(asset, accessor.sparse, "values");
  const json::NodeId type = document.find(sparse.indices.node, "componentType");
  if (type != json::kNoNode) {
    sparse.indices.format = {ElementType::scalar, read_component(document, type), false};
  }
  sparse.values.format = accessor.format;
  const bool complete =
      sparse.count && sparse.indices.node != json::kNoNode && sparse.values.node != json::kNoNode;
  return complete ? std::optional(sparse) : std::nullopt;
}

}  // namespace gltfx::model
