// SPDX-License-Identifier: Apache-2.0
/// Accessors and buffer views as numbers instead of JSON: position and layout of their elements
/// (specification section 3.6).
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "model/asset.hpp"

namespace gltfx::model {

enum class ViewTarget : std::uint8_t { none, vertices, indices };

/// One buffer view. A member that is absent or malformed is an empty optional.
struct BufferView {
  json::NodeId node = json::kNoNode;    ///< kNoNode: the element of the array is not an object
  std::optional<std::uint32_t> buffer;  ///< index of an object
  std::optional<std::uint64_t> byte_offset;
  std::optional<std::uint64_t> byte_length;  ///< at least 1
  std::optional<std::uint64_t> byte_stride;  ///< 4 to 252
  ViewTarget target = ViewTarget::none;
};

BufferView read_buffer_view(const Asset& asset, json::NodeId object);

/// All buffer views, by index.
std::vector<BufferView> read_buffer_views(const Asset& asset);

enum class ElementType : std::uint8_t { none, scalar, vec2, vec3, vec4, mat2, mat3, mat4 };

/// OpenGL's numbers for component types. glTF 2.0 itself has six of them; extensions add the
/// others.
enum class ComponentType : std::uint16_t {
  none = 0,
  int8 = 5120,
  uint8 = 5121,
  int16 = 5122,
  uint16 = 5123,
  int32 = 5124,
  uint32 = 5125,
  float32 = 5126,
  float64 = 5130,
  float16 = 5131,
};

/// "VEC3"; empty for none.
std::string_view element_type_name(ElementType type);
std::optional<ElementType> element_type_from_name(std::string_view name);
/// "UNSIGNED_BYTE"; empty for none.
std::string_view component_type_name(ComponentType type);
/// Bytes of one component, 0 for none.
unsigned component_size(ComponentType type);
/// Whether it is one of the six types of glTF 2.0 itself.
bool is_core_component(ComponentType type);
/// Components of an element: 3 for VEC3, 9 for MAT3, 0 for none.
unsigned component_count(ElementType type);
bool is_matrix(ElementType type);

/// The format of an element.
struct Format {
  ElementType type = ElementType::none;
  ComponentType component = ComponentType::none;
  bool normalized = false;
  bool known() const { return type != ElementType::none && component != ComponentType::none; }
  bool operator==(const Format&) const = default;
};
/// "VEC3 of FLOAT", "VEC2 of normalized UNSIGNED_BYTE".
std::string format_text(const Format& format);

/// Bytes from the first to the last byte of one element; columns of matrices begin at multiples of
/// four bytes, the padding of the last column does not count. 0 when the format is unknown.
std::uint64_t element_size(const Format& format);
/// Bytes from one element to the next without an explicit stride; 0 when the format is unknown.
std::uint64_t packed_stride(const Format& format);

/// Smallest and largest value an integer component can hold; infinities for floating point.
struct ValueRange {
  double least, most;
  bool contains(double value) const { return value >= least && value <= most; }
};
ValueRange value_range(ComponentType type);
bool is_integer(ComponentType type);

/// Whether `array` is valid as `min` or `max` of an accessor: one number per component, each in the
/// range of the component type.
bool is_sound_bound(const json::Document& document, const Format& format, json::NodeId array);

/// One accessor. A member that is absent or malformed is an empty optional.
struct Accessor {
  json::NodeId node = json::kNoNode;  ///< kNoNode: the element of the array is not an object
  json::NodeId min = json::kNoNode;   ///< arrays of any content
  json::NodeId max = json::kNoNode;
  json::NodeId sparse = json::kNoNode;       ///< object
  std::optional<std::uint32_t> buffer_view;  ///< index of an object
  std::optional<std::uint64_t> byte_offset;  ///< as written
  std::optional<std::uint64_t> count;        ///< at least 1
  Format format;

  /// Bytes from the first to the last byte of all elements at distances of `stride`, or nothing
  /// when that is beyond 64 bits.
  std::optional<std::uint64_t> span_size(std::uint64_t stride) const;
};

Accessor read_accessor(const Asset& asset, json::NodeId object);

/// All accessors, by index.
std::vector<Accessor> read_accessors(const Asset& asset);

/// A part of a sparse accessor: the place of its indices or its values.
struct SparsePart {
  json::NodeId node = json::kNoNode;
  std::optional<std::uint32_t> buffer_view;
  std::optional<std::uint64_t> byte_offset;
  Format format;  ///< SCALAR for indices, that of the accessor for values
};

struct Sparse {
  std::optional<std::uint64_t> count;  ///< at least 1
  SparsePart indices, values;
};

/// Whether the type is allowed for indices of sparse accessors.
bool can_index_elements(ComponentType type);

/// The sparse object of an accessor, or nothing when it has none or one that lacks a part.
std::optional<Sparse> read_sparse(const Asset& asset, const Accessor& accessor);

}  // namespace gltfx::model
