// SPDX-License-Identifier: Apache-2.0
#include "schema/json_schema.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "base/number.hpp"
#include "base/text.hpp"
#include "schema/holds.hpp"
#include "schema/json_schema_evaluation.hpp"
#include "schema/phrases.hpp"

namespace gltfx::schema {

namespace {

using Kind = Assertion::Kind;

// Values and schemas inside one another: bounds the call stack.
constexpr int kDeepest = 200;

// Bytes of a text that are read in the time of a step.
constexpr std::uint64_t kBytesOfAStep = 16;

}  // namespace

bool Evaluation::fits(std::uint32_t id, const JsonValue& value, const Path& path,
                      SchemaFailure* failure) {
  const Subschema& schema = schema_.subschemas()[id];
  const Frame at{value, path, failure};
  if (schema.never) return fail(at, [] { return std::string("nothing is allowed here"); });
  if (depth_ == kDeepest) exhausted_ = true;
  if (!spend(1 + schema.assertions.size())) return true;
  ++depth_;
  const bool all = std::all_of(schema.assertions.begin(), schema.assertions.end(),
                               [&](const Assertion& one) { return holds(one, at); });
  --depth_;
  return all;
}

bool Evaluation::holds(const Assertion& assertion, const Frame& at) {
  if (exhausted_) return true;
  switch (assertion.kind) {
    case Kind::type:
      return has_type(assertion, at);
    case Kind::equals:
      return equals_one(assertion, at);
    case Kind::minimum:
    case Kind::exclusive_minimum:
    case Kind::maximum:
    case Kind::exclusive_maximum:
    case Kind::multiple_of:
      return at.value.kind() != json::Kind::number || number_holds(assertion, at);
    case Kind::min_length:
    case Kind::max_length:
    case Kind::pattern:
      return at.value.kind() != json::Kind::string || text_holds(assertion, at);
    case Kind::min_items:
    case Kind::max_items:
    case Kind::unique_items:
    case Kind::prefix_items:
    case Kind::items:
    case Kind::contains:
      return !at.value.is_array() || array_holds(assertion, at);
    case Kind::min_properties:
    case Kind::max_properties:
    case Kind::required:
    case Kind::properties:
    case Kind::pattern_properties:
    case Kind::additional_properties:
    case Kind::property_names:
    case Kind::dependent_required:
    case Kind::dependent_schemas:
      return at.value.kind() != json::Kind::object || object_holds(assertion, at);
    default:
      return combination_holds(assertion, at);
  }
}

bool Evaluation::has_type(const Assertion& assertion, const Frame& at) const {
  if ((at.value.types() & assertion.types) != 0) return true;
  if (at.failure == nullptr) return false;
  return fail(at, [&] {
    return fmt::format("it is {} and must be {}", type_phrase(at.value.types()),
                       type_phrase(assertion.types));
  });
}

bool Evaluation::equals_one(const Assertion& assertion, const Frame& at) {
  const json::Document& ours = schema_.document();
  std::vector<std::string> words;
  for (const json::NodeId literal : assertion.literals) {
    const bool numbers = assertion.least == 1;
    if (!spend(1 + ours.raw(literal).size() + at.value.raw().size() / kBytesOfAStep)) return true;
    if (!numbers) {
      if (equal_values(at.value, {&ours, literal})) return true;
      if (at.failure != nullptr) words.push_back(shown(ours.raw(literal)));
      continue;
    }
    for (json::NumberCursor number(ours, literal); number.valid(); number.advance()) {
      if (equal_values(at.value, {&ours, literal, &number.number()})) return true;
      if (at.failure != nullptr) words.push_back(shown(number.number().span.in(ours.text())));
    }
  }
  if (at.failure == nullptr) return false;
  return fail(at,
              [&] { return fmt::format("{} is not {}", shown(at.value.raw()), join_or(words)); });
}

bool Evaluation::number_holds(const Assertion& assertion, const Frame& at) const {
  const double number = at.value.number();
  const double limit = assertion.number;
  const auto refuse = [&](std::string_view what) {
    return fail(
        at, [&] { return fmt::format("{} is {} {}", at.value.raw(), what, number_text(limit)); });
  };
  switch (assertion.kind) {
    case Kind::minimum:
      return number >= limit || refuse("less than");
    case Kind::exclusive_minimum:
      return number > limit || refuse("not greater than");
    case Kind::maximum:
      return number <= limit || refuse("greater than");
    case Kind::exclusive_maximum:
      return number < limit || refuse("not less than");
    default:
      return is_multiple(number, limit) || refuse("not a multiple of");
  }
}

bool Evaluation::matches(const Pattern& pattern, std::string_view text) {
  return !spend(1 + text.size() * pattern.size() / kBytesOfAStep) || pattern.matches(text);
}

bool Evaluation::text_holds(const Assertion& assertion, const Frame& at) {
  std::string buffer;
  const std::string_view text = at.value.document->string(at.value.node, buffer);
  if (assertion.kind == Kind::pattern) {
    const Pattern& pattern = assertion.patterns.front();
    return matches(pattern, text) || fail(at, [&] {
             return fmt::format("{} does not match {}", quoted(text), quoted(pattern.text(), 200));
           });
  }
  if (!spend(text.size() / kBytesOfAStep)) return true;
  return size_holds(assertion, at, count_code_points(text), "character");
}

bool Evaluation::size_holds(const Assertion& assertion, const Frame& at, std::uint64_t size,
                            std::string_view what) const {
  const bool lower = assertion.kind == Kind::min_length || assertion.kind == Kind::min_items ||
                     assertion.kind == Kind::min_properties;
  if (lower ? size >= assertion.least : size <= assertion.most) return true;
  return fail(at, [&] {
    return fmt::format("it has {} {}{} and must have at {} {}", size, what, size == 1 ? "" : "s",
                       lower ? "least" : "most", assertion.least);
  });
}

bool Evaluation::combination_holds(const Assertion& assertion, const Frame& at) {
  const auto inside = [&](std::uint32_t id, SchemaFailure* failure) {
    return fits(id, at.value, at.path, failure);
  };
  switch (assertion.kind) {
    case Kind::reference:
    case Kind::all_of:
      return std::all_of(assertion.schemas.begin(), assertion.schemas.end(),
                         [&](std::uint32_t id) { return inside(id, at.failure); });
    case Kind::any_of:
    case Kind::one_of:
      return one_fits(assertion, at);
    case Kind::not_:
      return does_not_fit(assertion, at);
    default:
      break;
  }
  const std::uint32_t branch = assertion.schemas[inside(assertion.schemas[0], nullptr) ? 1 : 2];
  return branch == kNoSchema || inside(branch, at.failure);
}

bool Evaluation::one_fits(const Assertion& assertion, const Frame& at) {
  const bool any = assertion.kind == Kind::any_of;
  std::size_t found = 0;
  for (const std::uint32_t id : assertion.schemas) {
    if (fits(id, at.value, at.path, nullptr)) ++found;
    if (exhausted_ || (any && found > 0)) return true;
  }
  if (found == 1) return true;
  if (at.failure == nullptr) return false;
  if (found > 1) {
    return fail(at, [&] {
      return fmt::format("it fits {} of the schemas in 'oneOf' and must fit one", found);
    });
  }
  // Why the last one does not fit: often the only one that was meant.
  SchemaFailure last;
  fits(assertion.schemas.back(), at.value, at.path, &last);
  return fail(at, [&] {
    return fmt::format("it fits none of the schemas in '{}'; of the last: {}{}{}",
                       any ? "anyOf" : "oneOf", last.pointer, last.pointer.empty() ? "" : ": ",
                       last.reason);
  });
}

bool Evaluation::does_not_fit(const Assertion& assertion, const Frame& at) {
  const std::uint32_t id = assertion.schemas[0];
  if (!fits(id, at.value, at.path, nullptr) || exhausted_) return true;
  const Subschema& refused = schema_.subschemas()[id];
  const bool lone = refused.assertions.size() == 1;
  if (lone && refused.assertions[0].kind == Kind::required &&
      at.value.kind() == json::Kind::object) {
    return fail(at, [&] {
      return fmt::format("{} must not be there", join_and(refused.assertions[0].names));
    });
  }
  return fail(at, [] { return std::string("it fits the schema in 'not'"); });
}

SchemaVerdict JsonSchema::check(const CheckedObject& object, std::uint64_t& work,
                                SchemaFailure& failure) const {
  Evaluation evaluation(*this, object, work);
  const bool fits =
      evaluation.fits(0, JsonValue{&object.document, object.object}, Path(), &failure);
  if (evaluation.exhausted()) return SchemaVerdict::undecided;
  return fits ? SchemaVerdict::fits : SchemaVerdict::fails;
}

}  // namespace gltfx::schema
