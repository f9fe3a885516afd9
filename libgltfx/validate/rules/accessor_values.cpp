// SPDX-License-Identifier: Apache-2.0
// What an accessor says of its elements: bounds of the right number and kind, normalization,
// columns of matrices.
#include <cmath>

#include <fmt/format.h>

#include "base/text.hpp"
#include "model/accessor.hpp"
#include "model/fields.hpp"
#include "validate/rules/families.hpp"
#include "validate/rules/finding.hpp"

namespace gltfx::validate {
namespace {

constexpr RuleDescription kRules[] = {
    {"ACCESSOR_MATRIX_ALIGNMENT", Severity::error,
     "The matrices of an accessor do not begin at a multiple of four bytes",
     "Columns of matrices lie on four-byte boundaries, so that they can be copied as they are.",
     "Move the data, and make byteOffset a multiple of 4.",
     R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
 "meshes": [{"primitives": [{"attributes": {"POSITION": 0, "_TWIST": 1}, "mode": 0}]}],
 "accessors": [{"componentType": 5126, "type": "VEC3", "count": 1, "min": [0, 0, 0], "max": [0, 0, 0]},
  {"bufferView": 0, "byteOffset": 2, "componentType": 5121, "type": "MAT2", "count": 1}],
 "bufferViews": [{"buffer": 0, "byteLength": 12, "byteStride": 8, "target": 34962}],
 "buffers": [{"byteLength": 12, "uri": "data:application/octet-stream;base64,AAAAAAAAAAAAAAAA"}]})",
     R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
 "meshes": [{"primitives": [{"attributes": {"POSITION": 0, "_TWIST": 1}, "mode": 0}]}],
 "accessors": [{"componentType": 5126, "type": "VEC3", "count": 1, "min": [0, 0, 0], "max": [0, 0, 0]},
  {"bufferView": 0, "byteOffset": 4, "componentType": 5121, "type": "MAT2", "count": 1}],
 "bufferViews": [{"buffer": 0, "byteLength": 12, "byteStride": 8, "target": 34962}],
 "buffers": [{"byteLength": 12, "uri": "data:application/octet-stream;base64,AAAAAAAAAAAAAAAA"}]})",
     Fix::none, true},
    {"ACCESSOR_NORMALIZED_INVALID", Severity::error,
     "An accessor of floats or 32-bit integers is normalized",
     "Normalization maps small integers to fractions. For other types it has no meaning, and "
     "readers differ in what they do.",
     "Remove normalized.",
     R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
 "meshes": [{"primitives": [{"attributes": {"POSITION": 0, "_HEAT": 1}, "mode": 0}]}],
 "accessors": [{"componentType": 5126, "type": "VEC3", "count": 1, "min": [0, 0, 0], "max": [0, 0, 0]},
  {"componentType": 5126, "type": "SCALAR", "count": 1, "normalized": true}]})",
     R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
 "meshes": [{"primitives": [{"attributes": {"POSITION": 0, "_HEAT": 1}, "mode": 0}]}],
 "accessors": [{"componentType": 5126, "type": "VEC3", "count": 1, "min": [0, 0, 0], "max": [0, 0, 0]},
  {"componentType": 5126, "type": "SCALAR", "count": 1}]})",
     Fix::none, true},
    {"INVALID_GL_VALUE", Severity::error,
     "A bound of an accessor cannot be a value of its component type",
     "min and max hold values as they are stored. One that does not fit the type was most often "
     "taken before packing, and readers that allocate or cull by it go wrong.",
     "Write the smallest and largest stored values.",
     R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
 "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1, "mode": 0}]}],
 "accessors": [{"componentType": 5126, "type": "VEC3", "count": 1, "min": [0, 0, 0], "max": [0, 0, 0]},
  {"componentType": 5121, "type": "SCALAR", "count": 1, "min": [0], "max": [300]}]})",
     R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
 "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1, "mode": 0}]}],
 "accessors": [{"componentType": 5126, "type": "VEC3", "count": 1, "min": [0, 0, 0], "max": [0, 0, 0]},
  {"componentType": 5121, "type": "SCALAR", "count": 1, "min": [0], "max": [0]}]})",
     Fix::none, true},
};

void check_bound_values(const Context& context, const model::Accessor& accessor, json::NodeId array,
                        const Path& path) {
  if (!model::is_integer(accessor.format.component)) return;
  if (context.document.kind(array) != json::Kind::number_array) return;
  const model::ValueRange range = model::value_range(accessor.format.component);
  const std::string_view type = model::component_type_name(accessor.format.component);
  for (json::NumberCursor at(context.document, array); at.valid(); at.advance()) {
    const double value = at.number().value;
    const bool whole = at.number().is_integer();
    if (whole && range.contains(value)) continue;
    if (!std::isfinite(value)) continue;
    Finding finding = finding_on(
        context, array, whole ? "INVALID_GL_VALUE" : "ARRAY_TYPE_MISMATCH",
        whole ? fmt::format("{} is no value of a component of type {}, which goes from {} to {}.",
                            number_text(value), type, number_text(range.least),
                            number_text(range.most))
              : fmt::format("{} is no integer, but components are of type {}.", number_text(value),
                            type));
    finding.span = at.number().span;
    context.schema_sink.report(path, std::move(finding));
  }
}

// The schema bounds the length by 1 and 16; the type says which it is.
void report_bound_length(const Context& context, const model::Accessor& accessor,
                         json::NodeId array, std::size_t size, const Path& path) {
  const unsigned components = model::component_count(accessor.format.type);
  context.schema_sink.report(
      path, finding_on(context, array, "ARRAY_LENGTH_NOT_IN_LIST",
                       fmt::format("A bound of {} elements has {} number{}, not {}.",
                                   model::element_type_name(accessor.format.type), components,
                                   components == 1 ? "" : "s", size)));
}

void check_bound(const Context& context, const model::Accessor& accessor, json::NodeId array,
                 const Path& path) {
  if (array == json::kNoNode) return;
  const std::size_t size = context.document.array_size(array);
  const unsigned components = model::component_count(accessor.format.type);
  if (size == 0 || size > 16) return;
  if (size == components) {
    check_bound_values(context, accessor, array, path);
    return;
  }
  report_bound_length(context, accessor, array, size, path);
}

void check_normalized(const Context& context, const model::Accessor& accessor, const Path& path) {
  using model::ComponentType;
  const ComponentType type = accessor.format.component;
  if (!accessor.format.normalized || type == ComponentType::none) return;
  if (model::component_size(type) <= 2 && model::is_core_component(type)) return;
  report_member(
      context.schema_sink, context, path, accessor.node, "normalized",
      "ACCESSOR_NORMALIZED_INVALID",
      fmt::format("Components of type {} cannot be normalized.", model::component_type_name(type)));
}

void check_matrix_offset(const Context& context, const model::Accessor& accessor,
                         const Path& path) {
  if (!model::is_matrix(accessor.format.type) || !accessor.byte_offset) return;
  if (context.document.find(accessor.node, "bufferView") == json::kNoNode) return;
  if (*accessor.byte_offset % 4 == 0) return;
  report_member(
      context.schema_sink, context, path, accessor.node, "byteOffset", "ACCESSOR_MATRIX_ALIGNMENT",
      fmt::format("Matrices begin at multiples of 4 bytes; {} is none.", *accessor.byte_offset));
}

void check_accessor(const Context& context, json::NodeId object, const Path& path) {
  const model::Accessor accessor = model::read_accessor(context.asset, object);
  if (accessor.format.known() && !context.khronos()) {
    check_bound(context, accessor, accessor.min, Path(path, "min"));
    check_bound(context, accessor, accessor.max, Path(path, "max"));
  }
  check_normalized(context, accessor, path);
  check_matrix_offset(context, accessor, path);
}

// --- As the Khronos validator reads them ---

schema::Reading read_offset(const Context& context, json::NodeId object, json::NodeId value,
                            const Path& path) {
  if (context.document.find(object, "bufferView") != json::kNoNode) return schema::Reading::judge;
  context.schema_sink.report(
      Path(path, "byteOffset"),
      finding_on(context, value, "UNSATISFIED_DEPENDENCY", "'byteOffset' needs 'bufferView'."));
  return schema::Reading::drop;
}

// Integers: whatever is none, or none of the type's, makes the bound void.
schema::Reading read_integers(const Context& context, const model::Accessor& accessor,
                              json::NodeId array, const Path& path) {
  const json::Document& document = context.document;
  const model::ValueRange range = model::value_range(accessor.format.component);
  bool sound = true;
  const auto check = [&](bool whole, double value, Span span) {
    if (whole && range.contains(value)) return;
    sound = false;
    Finding finding =
        finding_on(context, array, whole ? "INVALID_GL_VALUE" : "ARRAY_TYPE_MISMATCH",
                   fmt::format("A bound of components of type {} has other values.",
                               model::component_type_name(accessor.format.component)));
    finding.span = span;
    context.schema_sink.report(path, std::move(finding));
  };
  const auto check_number = [&](const json::Number& number) {
    const bool whole = std::isfinite(number.value) && number.value == std::trunc(number.value);
    check(whole, number.value, number.span);
  };
  if (document.kind(array) == json::Kind::number_array) {
    for (json::NumberCursor at(document, array); at.valid(); at.advance())
      check_number(at.number());
  } else {
    for (const json::NodeId element : document.elements(array)) {
      document.is_number(element) ? check_number(document.number(element))
                                  : check(false, 0, document.span(element));
    }
  }
  return sound ? schema::Reading::keep : schema::Reading::drop;
}

schema::Reading read_bound(const Context& context, json::NodeId object, json::NodeId value,
                           const Path& path) {
  const model::Accessor accessor = model::read_accessor(context.asset, object);
  if (!accessor.format.known()) return schema::Reading::drop;
  if (!context.document.is_array(value)) return schema::Reading::judge;
  const std::size_t size = context.document.array_size(value);
  const bool integer = model::is_integer(accessor.format.component);
  if (size == model::component_count(accessor.format.type)) {
    return integer ? read_integers(context, accessor, value, path) : schema::Reading::judge;
  }
  if (size == 0 && !integer) return schema::Reading::judge;
  report_bound_length(context, accessor, value, size, path);
  return schema::Reading::drop;
}

schema::Reading read_min(const Context& context, json::NodeId object, json::NodeId value,
                         const Path& path) {
  return read_bound(context, object, value, Path(path, "min"));
}
schema::Reading read_max(const Context& context, json::NodeId object, json::NodeId value,
                         const Path& path) {
  return read_bound(context, object, value, Path(path, "max"));
}

constexpr ObjectRuleEntry kObjectRules[] = {{"accessor", check_accessor, "sparse"}};
constexpr MemberRuleEntry kMemberRules[] = {{"accessor", "byteOffset", read_offset},
                                            {"accessor", "min", read_min},
                                            {"accessor", "max", read_max}};

}  // namespace

const Family& accessor_values_family() {
  static const Family family{"accessor_values", kRules, kObjectRules, {}, kMemberRules};
  return family;
}

}  // namespace gltfx::validate
