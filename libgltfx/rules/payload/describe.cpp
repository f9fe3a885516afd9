// SPDX-License-Identifier: Apache-2.0
#include "rules/payload/describe.hpp"

#include <array>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "base/codes.hpp"
#include "base/number.hpp"
#include "base/text.hpp"
#include "rules/core/fix_data.hpp"
#include "rules/finding.hpp"
#include "rules/payload/element_kernels.hpp"

namespace gltfx::validate {
namespace {

constexpr std::array<Code, kErrorKinds> kErrorCodes{
    Code::ACCESSOR_INVALID_FLOAT,
    Code::ACCESSOR_VECTOR3_NON_UNIT,
    Code::ACCESSOR_INVALID_SIGN,
    Code::ACCESSOR_NON_CLAMPED,
    Code::ACCESSOR_INDEX_OOB,
    Code::ACCESSOR_INDEX_PRIMITIVE_RESTART,
    Code::ACCESSOR_ANIMATION_INPUT_NEGATIVE,
    Code::ACCESSOR_ANIMATION_INPUT_NON_INCREASING,
    Code::ACCESSOR_ANIMATION_SAMPLER_OUTPUT_NON_NORMALIZED_QUATERNION,
    Code::ACCESSOR_INVALID_IBM,
    Code::INSTANCING_ROTATION_NON_UNIT,
    Code::SPLAT_ROTATION_NON_UNIT,
    Code::SPLAT_SCALE_NEGATIVE,
    Code::SPLAT_OPACITY_OUT_OF_RANGE,
    Code::ANIMATION_POINTER_OUTPUT_OUT_OF_RANGE,
};

std::string place_text(const ScanResult& scan_result, const DataError& error) {
  const std::uint64_t element = error.index / scan_result.components;
  if (scan_result.components == 1) return fmt::format("Element {}", element);
  return fmt::format("Component {} of element {}", error.component, element);
}

std::string sentence(const ScanResult& scan_result, const DataError& error) {
  const std::string value = value_text(error.value);
  const std::uint64_t element = error.index / scan_result.components;
  switch (error.kind) {
    case ErrorKind::invalid_float:
      return fmt::format("{} is {}.", place_text(scan_result, error), value);
    case ErrorKind::not_unit:
      return fmt::format("The vector in element {} has length {}; it must be 1.", element, value);
    case ErrorKind::bad_sign:
      return fmt::format("w of element {} is {}; it must be 1 or -1.", element, value);
    case ErrorKind::not_clamped:
    case ErrorKind::bad_opacity:
      return fmt::format("{} is {}; it must be between 0 and 1.", place_text(scan_result, error),
                         value);
    case ErrorKind::index_out_of_range:
      return fmt::format("Element {} of the indices is {}, but the primitive has {} vertices.",
                         element, value, error.other < 0 ? "no" : value_text(error.other + 1));
    case ErrorKind::restart:
      return fmt::format("Element {} of the indices is {}, which is the primitive restart value.",
                         element, value);
    case ErrorKind::negative_time:
      return fmt::format("Time {} is {}; it must not be negative.", element, value);
    case ErrorKind::not_increasing:
      return fmt::format("Time {} is {}; it must be greater than the previous one, {}.", element,
                         value, value_text(error.other));
    case ErrorKind::not_unit_quaternion:
    case ErrorKind::not_unit_instance:
    case ErrorKind::not_unit_splat:
      return fmt::format("The quaternion in element {} has length {}; it must be 1.", element,
                         value);
    case ErrorKind::out_of_limits:
      return fmt::format("{} is {}; the property must be {} {}.", place_text(scan_result, error),
                         value, error.value <= error.other ? "at least" : "at most",
                         value_text(error.other));
    case ErrorKind::negative_scale:
      return fmt::format("{} is {}; it must not be negative.", place_text(scan_result, error),
                         value);
    case ErrorKind::bad_matrix:
      return fmt::format("{} is {}; it must be {}.", place_text(scan_result, error), value,
                         value_text(error.other));
  }
  return {};
}

// Whether a vector of that length has unit length in numbers of fewer bits than their type: an
// encoder with such a precision did not scale them up. Readers that normalize, as they do between
// vertices anyway, do not show a difference.
bool has_fewer_bits(model::ComponentType type, double length) {
  if (type != model::ComponentType::int8 && type != model::ComponentType::int16) return false;
  const double greatest = model::value_range(type).most;
  for (int bits = 2; bits < 15; ++bits) {
    const double narrow = (1 << bits) - 1;
    if (narrow >= greatest) break;
    const double unit = narrow / greatest;
    if (std::abs(length / unit - 1.0) <= kernels::kVectorTolerance + 1.0 / narrow) return true;
  }
  return false;
}

// Whether an error may be due to rounded values.
bool is_of_values(ErrorKind kind) {
  switch (kind) {
    case ErrorKind::not_unit:
    case ErrorKind::bad_sign:
    case ErrorKind::not_clamped:
    case ErrorKind::not_unit_splat:
    case ErrorKind::negative_scale:
    case ErrorKind::bad_opacity:
      return true;
    default:
      return false;
  }
}

// Changes by an encoder are not errors of the asset's author, and readers accept them.
void soften(const ScanResult& scan_result, Finding& finding) {
  if (!scan_result.draco) return;
  if (scan_result.lossy) finding.severity = Severity::warning;
  finding.message += scan_result.lossy ? kAfterDraco : " This is the value after Draco decoding.";
}

Finding finding_at_bound(const ScanResult& scan_result, const Check& check, const BoundError& error,
                         Code code, std::string message) {
  Finding finding(code);
  finding.message = std::move(message);
  soften(scan_result, finding);
  finding.span = element_span(scan_result.context.document, check.place.node, error.component);
  return finding;
}

constexpr FixEntry kElementFixes[] = {
    {Code::ACCESSOR_INVALID_FLOAT, fill_unused_or_normals, FixStage::document, fill_some_normals},
    {Code::ACCESSOR_VECTOR3_NON_UNIT, make_unit_or_fill, FixStage::document, fill_some_normals},
    {Code::ACCESSOR_INVALID_SIGN, make_signs},
    {Code::ACCESSOR_NON_CLAMPED, clamp},
    {Code::ACCESSOR_ANIMATION_SAMPLER_OUTPUT_NON_NORMALIZED_QUATERNION, make_unit_keyframes},
    {Code::INSTANCING_ROTATION_NON_UNIT, make_unit_rotations},
    {Code::SPLAT_ROTATION_NON_UNIT, make_unit_rotations},
    {Code::ACCESSOR_MIN_MISMATCH, correct_bounds},
    {Code::ACCESSOR_MAX_MISMATCH, correct_bounds},
    {Code::ACCESSOR_ELEMENT_OUT_OF_MIN_BOUND, correct_bounds},
    {Code::ACCESSOR_ELEMENT_OUT_OF_MAX_BOUND, correct_bounds},
};

}  // namespace

const RuleGroup& element_values_rules() {
  static constexpr RuleGroup group{.fixes = kElementFixes};
  return group;
}

std::string value_text(double value) {
  if (std::isnan(value)) return "NaN";
  if (std::isinf(value)) return value < 0 ? "negative infinity" : "infinity";
  return number_text(value);
}

Span element_span(const json::Document& document, json::NodeId array, std::uint64_t position) {
  for (json::NumberCursor at(document, array); at.valid(); at.advance()) {
    if (position-- == 0) return at.number().span;
  }
  return first_character(document, array);
}

Finding describe(const ScanResult& scan_result, const Check& check, const DataError& error,
                 std::uint64_t count) {
  std::string message = sentence(scan_result, error);
  if (count > 1) message += fmt::format(" This is the first of {}.", count);
  Finding finding =
      finding_on(scan_result.context, check.place.node,
                 kErrorCodes[static_cast<std::size_t>(error.kind)], std::move(message));
  finding.count = count;
  if (error.kind == ErrorKind::not_unit && has_fewer_bits(scan_result.decoded, error.value)) {
    finding.severity = Severity::warning;
  }
  if (is_of_values(error.kind)) soften(scan_result, finding);
  return finding;
}

Finding describe_mismatch(const ScanResult& scan_result, const Check& check,
                          const BoundError& error) {
  const bool minimum = check.kind == CheckKind::minimum;
  return finding_at_bound(scan_result, check, error,
                          minimum ? Code::ACCESSOR_MIN_MISMATCH : Code::ACCESSOR_MAX_MISMATCH,
                          fmt::format("{} is {}; it must be {}.", minimum ? "min" : "max",
                                      value_text(error.declared), value_text(error.actual)));
}

Finding describe_outside(const ScanResult& scan_result, const Check& check,
                         const BoundError& error) {
  const bool minimum = check.kind == CheckKind::minimum;
  return finding_at_bound(
      scan_result, check, error,
      minimum ? Code::ACCESSOR_ELEMENT_OUT_OF_MIN_BOUND : Code::ACCESSOR_ELEMENT_OUT_OF_MAX_BOUND,
      fmt::format("{} of {} elements are {} the declared {}, {}.", error.outside, scan_result.count,
                  minimum ? "below" : "above", minimum ? "min" : "max",
                  value_text(error.declared)));
}

Finding describe_degenerate(const ScanResult& scan_result, const Check& check,
                            std::uint64_t count) {
  return finding_on(
      scan_result.context, check.place.node, Code::ACCESSOR_INDEX_TRIANGLE_DEGENERATE,
      fmt::format("{} of {} triangles are degenerate.", count, scan_result.count / 3));
}

}  // namespace gltfx::validate
