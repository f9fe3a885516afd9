// SPDX-License-Identifier: Apache-2.0
#include "validate/data/describe.hpp"

#include <array>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "base/codes.hpp"
#include "base/text.hpp"
#include "validate/data/kernels.hpp"
#include "validate/rules/finding.hpp"

namespace gltfx::validate {
namespace {

constexpr std::array<Code, kFaultKinds> kFaultCodes{
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

std::string place_text(const ScanResult& scan_result, const Fault& fault) {
  const std::uint64_t element = fault.index / scan_result.components;
  if (scan_result.components == 1) return fmt::format("Element {}", element);
  return fmt::format("Component {} of element {}", fault.component, element);
}

std::string sentence(const ScanResult& scan_result, const Fault& fault) {
  const std::string value = value_text(fault.value);
  const std::uint64_t element = fault.index / scan_result.components;
  switch (fault.kind) {
    case FaultKind::invalid_float:
      return fmt::format("{} is {}.", place_text(scan_result, fault), value);
    case FaultKind::not_unit:
      return fmt::format("The vector in element {} has length {}; it must be 1.", element, value);
    case FaultKind::bad_sign:
      return fmt::format("w of element {} is {}; it must be 1 or -1.", element, value);
    case FaultKind::not_clamped:
    case FaultKind::bad_opacity:
      return fmt::format("{} is {}; it must be between 0 and 1.", place_text(scan_result, fault),
                         value);
    case FaultKind::index_out_of_range:
      return fmt::format("Element {} of the indices is {}, but the primitive has {} vertices.",
                         element, value, fault.other < 0 ? "no" : value_text(fault.other + 1));
    case FaultKind::restart:
      return fmt::format("Element {} of the indices is {}, which is the primitive restart value.",
                         element, value);
    case FaultKind::negative_time:
      return fmt::format("Time {} is {}; it must not be negative.", element, value);
    case FaultKind::not_increasing:
      return fmt::format("Time {} is {}; it must be greater than the previous one, {}.", element,
                         value, value_text(fault.other));
    case FaultKind::not_unit_quaternion:
    case FaultKind::not_unit_instance:
    case FaultKind::not_unit_splat:
      return fmt::format("The quaternion in element {} has length {}; it must be 1.", element,
                         value);
    case FaultKind::out_of_limits:
      return fmt::format("{} is {}; the property must be {} {}.", place_text(scan_result, fault),
                         value, fault.value <= fault.other ? "at least" : "at most",
                         value_text(fault.other));
    case FaultKind::negative_scale:
      return fmt::format("{} is {}; it must not be negative.", place_text(scan_result, fault),
                         value);
    case FaultKind::bad_matrix:
      return fmt::format("{} is {}; it must be {}.", place_text(scan_result, fault), value,
                         value_text(fault.other));
  }
  return {};
}

// Whether a vector of that length is of unit length in numbers of fewer bits than their type has:
// an encoder that was asked for such a precision did not scale them up. Readers that normalize, as
// they do with vectors between vertices anyway, see nothing of it.
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

// Whether a fault may come of values that were rounded.
bool is_of_values(FaultKind kind) {
  switch (kind) {
    case FaultKind::not_unit:
    case FaultKind::bad_sign:
    case FaultKind::not_clamped:
    case FaultKind::not_unit_splat:
    case FaultKind::negative_scale:
    case FaultKind::bad_opacity:
      return true;
    default:
      return false;
  }
}

// What an encoder may have changed is no fault of the asset's author, and no reader minds.
void soften(const ScanResult& scan_result, Finding& finding) {
  if (!scan_result.draco) return;
  if (scan_result.lossy) finding.severity = Severity::warning;
  finding.message += scan_result.lossy ? kAfterDraco : " This is the value after Draco decoding.";
}

Finding finding_at_bound(const ScanResult& scan_result, const Check& check, const BoundFault& fault,
                         Code code, std::string message) {
  Finding finding(code);
  finding.message = std::move(message);
  soften(scan_result, finding);
  finding.span = element_span(scan_result.context.document, check.place.node, fault.component);
  return finding;
}

}  // namespace

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

Finding describe(const ScanResult& scan_result, const Check& check, const Fault& fault,
                 std::uint64_t count) {
  std::string message = sentence(scan_result, fault);
  if (count > 1) message += fmt::format(" This is the first of {}.", count);
  Finding finding =
      finding_on(scan_result.context, check.place.node,
                 kFaultCodes[static_cast<std::size_t>(fault.kind)], std::move(message));
  finding.count = count;
  if (fault.kind == FaultKind::not_unit && has_fewer_bits(scan_result.decoded, fault.value)) {
    finding.severity = Severity::warning;
  }
  if (is_of_values(fault.kind)) soften(scan_result, finding);
  return finding;
}

Finding describe_mismatch(const ScanResult& scan_result, const Check& check,
                          const BoundFault& fault) {
  const bool minimum = check.kind == CheckKind::minimum;
  return finding_at_bound(scan_result, check, fault,
                          minimum ? Code::ACCESSOR_MIN_MISMATCH : Code::ACCESSOR_MAX_MISMATCH,
                          fmt::format("{} is {}; it must be {}.", minimum ? "min" : "max",
                                      value_text(fault.declared), value_text(fault.actual)));
}

Finding describe_outside(const ScanResult& scan_result, const Check& check,
                         const BoundFault& fault) {
  const bool minimum = check.kind == CheckKind::minimum;
  return finding_at_bound(
      scan_result, check, fault,
      minimum ? Code::ACCESSOR_ELEMENT_OUT_OF_MIN_BOUND : Code::ACCESSOR_ELEMENT_OUT_OF_MAX_BOUND,
      fmt::format("{} of {} elements are {} the declared {}, {}.", fault.outside, scan_result.count,
                  minimum ? "below" : "above", minimum ? "min" : "max",
                  value_text(fault.declared)));
}

Finding describe_degenerate(const ScanResult& scan_result, const Check& check,
                            std::uint64_t count) {
  return finding_on(
      scan_result.context, check.place.node, Code::ACCESSOR_INDEX_TRIANGLE_DEGENERATE,
      fmt::format("{} of {} triangles are degenerate.", count, scan_result.count / 3));
}

}  // namespace gltfx::validate
