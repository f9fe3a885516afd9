// SPDX-License-Identifier: Apache-2.0
// Members of an accessor about its elements: number and kind of bounds, normalization, columns of
// matrices.
#include <cmath>

#include <fmt/format.h>

#include "base/codes.hpp"
#include "base/number.hpp"
#include "base/text.hpp"
#include "model/accessor.hpp"
#include "rules/context.hpp"
#include "rules/core/fix_data.hpp"
#include "rules/finding.hpp"

namespace gltfx::validate {
namespace {

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
    Finding finding =
        finding_on(context, array, whole ? Code::INVALID_GL_VALUE : Code::ARRAY_TYPE_MISMATCH,
                   whole ? fmt::format("{} is out of range of {}; it must be between {} and {}.",
                                       number_text(value), type, number_text(range.least),
                                       number_text(range.most))
                         : fmt::format("{} is not an integer, but the component type is {}.",
                                       number_text(value), type));
    finding.span = at.number().span;
    context.schema_sink.report(path, std::move(finding));
  }
}

// The schema limits the length to 1 to 16; the type gives the exact length.
void report_bound_length(const Context& context, const model::Accessor& accessor,
                         json::NodeId array, std::size_t size, const Path& path) {
  const unsigned components = model::component_count(accessor.format.type);
  context.schema_sink.report(
      path, finding_on(context, array, Code::ARRAY_LENGTH_NOT_IN_LIST,
                       fmt::format("The bound has {} number{}; for {} it must have {}.", size,
                                   size == 1 ? "" : "s",
                                   model::element_type_name(accessor.format.type), components)));
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
      Code::ACCESSOR_NORMALIZED_INVALID,
      fmt::format("Components of type {} cannot be normalized.", model::component_type_name(type)));
}

void check_matrix_offset(const Context& context, const model::Accessor& accessor,
                         const Path& path) {
  if (!model::is_matrix(accessor.format.type) || !accessor.byte_offset) return;
  if (context.document.find(accessor.node, "bufferView") == json::kNoNode) return;
  if (*accessor.byte_offset % 4 == 0) return;
  report_member(context.schema_sink, context, path, accessor.node, "byteOffset",
                Code::ACCESSOR_MATRIX_ALIGNMENT,
                fmt::format("byteOffset is {}; for matrices it must be a multiple of 4.",
                            *accessor.byte_offset));
}

void check_min_and_max(const Context& context, json::NodeId object, const Path& path) {
  const model::Accessor accessor = model::read_accessor(context.asset, object);
  if (!accessor.format.known()) return;
  check_bound(context, accessor, accessor.min, Path(path, "min"));
  check_bound(context, accessor, accessor.max, Path(path, "max"));
}

void check_accessor(const Context& context, json::NodeId object, const Path& path) {
  const model::Accessor accessor = model::read_accessor(context.asset, object);
  check_normalized(context, accessor, path);
  check_matrix_offset(context, accessor, path);
}

// --- In reading order ---

schema::Reading read_offset(const Context& context, json::NodeId object, json::NodeId value,
                            const Path& path) {
  if (context.document.find(object, "bufferView") != json::kNoNode) return schema::Reading::check;
  context.schema_sink.report(Path(path, "byteOffset"),
                             finding_on(context, value, Code::UNSATISFIED_DEPENDENCY,
                                        "'byteOffset' requires 'bufferView'."));
  return schema::Reading::drop;
}

// Integers: any other value, or one outside the range of the type, invalidates the bound.
schema::Reading read_integers(const Context& context, const model::Accessor& accessor,
                              json::NodeId array, const Path& path) {
  const json::Document& document = context.document;
  const model::ValueRange range = model::value_range(accessor.format.component);
  bool sound = true;
  const auto check = [&](bool whole, double value, Span span) {
    if (whole && range.contains(value)) return;
    sound = false;
    Finding finding =
        finding_on(context, array, whole ? Code::INVALID_GL_VALUE : Code::ARRAY_TYPE_MISMATCH,
                   fmt::format("The bound has a value that is out of range of {}.",
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
  if (!context.document.is_array(value)) return schema::Reading::check;
  const std::size_t size = context.document.array_size(value);
  const bool integer = model::is_integer(accessor.format.component);
  if (size == model::component_count(accessor.format.type)) {
    return integer ? read_integers(context, accessor, value, path) : schema::Reading::check;
  }
  if (size == 0 && !integer) return schema::Reading::check;
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

bool correct_bound_values(Fixing& fixing, const Subject& bound) {
  return write_bound(fixing, bound.node());
}

}  // namespace

const RuleGroup& accessor_values_rules() {
  static constexpr ObjectRuleEntry kObjectRules[] = {
      {"accessor", check_min_and_max, {}, Runs::otherwise}, {"accessor", check_accessor, "sparse"}};
  static constexpr MemberRuleEntry kMemberRules[] = {{"accessor", "byteOffset", read_offset},
                                                     {"accessor", "min", read_min},
                                                     {"accessor", "max", read_max}};
  static constexpr FixEntry kFixes[] = {{Code::ACCESSOR_NORMALIZED_INVALID, remove_marked},
                                        {Code::INVALID_GL_VALUE, correct_bound_values}};
  static constexpr RuleGroup group{
      .object_rules = kObjectRules, .member_rules = kMemberRules, .fixes = kFixes};
  return group;
}

}  // namespace gltfx::validate
