// SPDX-License-Identifier: Apache-2.0
// Scalars: first by their plan, then with the full check.
#include <algorithm>
#include <cmath>

#include "base/codes.hpp"
#include "base/number.hpp"
#include "base/text.hpp"
#include "schema/phrases.hpp"
#include "schema/walker.hpp"

namespace gltfx::schema {
namespace {

// RFC 6901: empty, or steps that begin with '/', in which '~' is followed by 0 or 1.
bool is_json_pointer(std::string_view text) { return split_pointer(text).has_value(); }

// Help for a colour from a program that counts from 0 to 255, or for a 0 out of range.
std::string range_help(const Shape& shape, double number, const Path& path) {
  if (number == 0) return shape.zero_hint;
  const bool byte = shape.minimum == 0 && shape.maximum == 1 && number > 1 && number <= 255 &&
                    number == std::floor(number);
  if (!byte || !path.is_index() || path.parent()->parent() == nullptr) return {};
  const Path& array = *path.parent();
  if (array.is_index() || array.key().find("olor") == std::string_view::npos) return {};
  return "use linear values from 0 to 1, not 0 to 255";
}

}  // namespace

// An unsigned integer of up to 15 digits: nearly every index.
bool Walker::is_small_index(json::NodeId node, std::uint64_t& index) const {
  const std::string_view raw = document_.raw(node);
  if (raw.size() > 15) return false;
  std::uint64_t number = 0;
  for (const char c : raw) {
    const unsigned digit = static_cast<unsigned char>(c) - unsigned{'0'};
    if (digit > 9) return false;
    number = number * 10 + digit;
  }
  index = number;
  return true;
}

bool Walker::value(ShapeId id, json::NodeId node, Step step) {
  if (id == kNone) return false;
  const ShapePlan& plan = tables_.shapes[id];
  const json::Kind kind = document_.kind(node);
  std::uint64_t index = 0;
  switch (plan.plan) {
    case Plan::any:
      return false;
    case Plan::number: {
      if (kind != json::Kind::number) break;
      if (plan.every_value && !deviations().infinite_numbers_are_out_of_range) return false;
      const double number = document_.number(node).value;
      if (number >= plan.low && number <= plan.high && std::isfinite(number)) return false;
      break;
    }
    case Plan::integer:
      if (kind != json::Kind::number || !is_small_index(node, index)) break;
      if (static_cast<double>(index) >= plan.low && static_cast<double>(index) <= plan.high)
        return false;
      break;
    case Plan::index: {
      if (options_.references != nullptr) break;
      if (kind != json::Kind::number || !is_small_index(node, index)) break;
      const TargetPlan& target = tables_.targets[plan.target];
      if (target.pointer.empty() || target.steps_over) break;
      ReferenceTargets::Array& array = targets_.from_root(plan.target);
      if (index >= array.size || !array.holes.empty()) break;
      array.used.mark(index, plan.of_extension);
      return false;
    }
    case Plan::boolean:
      if (kind == json::Kind::true_value || kind == json::Kind::false_value) return false;
      break;
    case Plan::text:
      if (kind == json::Kind::string) return false;
      break;
    case Plan::object:
      if (kind != json::Kind::object) break;
      if (!plan.members) return false;
      return walk(id, node, step, Mode::object);
    case Plan::array:
      if (kind == json::Kind::array || kind == json::Kind::number_array)
        return array(id, node, step);
      break;
    case Plan::choice:
    case Plan::full:
      break;
  }
  return in_full(id, node, step);
}

bool Walker::in_full(ShapeId id, json::NodeId node, Step step) {
  const Shape& shape = set_.shape(id);
  const Path path = path_of(node, step);
  const json::Kind kind = document_.kind(node);
  const bool is_container =
      kind == json::Kind::object || kind == json::Kind::array || kind == json::Kind::number_array;
  if (!is_container || shape.never) {
    check(id, {node}, path);
    return false;
  }
  if (!check_type(id, {node}, path)) return false;
  if (kind != json::Kind::object) return array(id, node, step);
  if (!tables_.shapes[id].members) return false;
  return walk(id, node, step, Mode::object);
}

// All checks of a shape for a scalar.
void Walker::check(ShapeId id, Value value, const Path& path) {
  const Shape& shape = set_.shape(id);
  if (shape.never) {
    report(path, Code::CONDITION_MISMATCH, values_.span(value),
           name_of(path) + " is not allowed here.");
    return;
  }
  if (!check_type(id, value, path)) return;
  if (!shape.literals.empty()) check_literals(id, value, path);
  if (values_.kind(value) == json::Kind::number) check_number(id, value, path);
  if (values_.kind(value) == json::Kind::string) check_text(id, value, path);
  if (tables_.shapes[id].combined) combine(id, value, path, false);
}

// Whether the place is an optional member of the current object.
bool Walker::may_be_absent(const Path& path) const {
  if (top_ == nullptr || top_->mode != Mode::object || path.is_index()) return false;
  const Property* property = set_.find_property(top_->type, path.key());
  return property == nullptr || !property->required;
}

bool Walker::check_type(ShapeId id, Value value, const Path& path) {
  const Shape& shape = set_.shape(id);
  if (values_.has_type(value, shape.types)) return true;
  if (shape.ref) discard_reference(id);
  unset_ = true;
  report(path, Code::TYPE_MISMATCH, values_.span(value),
         name_of(path) + " is " + shown(values_, value) + "; it must be " +
             type_phrase(shape.types) + ".",
         type_help(set_, values_, shape, value, may_be_absent(path)));
  return false;
}

void Walker::check_literals(ShapeId id, Value value, const Path& path) {
  const Shape& shape = set_.shape(id);
  const auto equal = [&](const Literal& literal) { return values_.equals(value, literal); };
  if (std::any_of(shape.literals.begin(), shape.literals.end(), equal)) return;
  if (shape.open_since != Version() && shape.open_since <= version_) return;
  if (is_added(id, value)) return;
  std::string help;
  if (values_.kind(value) == json::Kind::string) {
    const std::string text = document_.string(value.node);
    std::vector<std::string_view> known;
    for (const Literal& literal : shape.literals) known.push_back(literal.string);
    help = did_you_mean(text, known);
  } else {
    unset_ = true;
  }
  std::string message =
      name_of(path) + " is " + shown(values_, value) + "; it must be " + list_phrase(shape) + ".";
  if (shape.is_const) {
    report(path, Code::CONDITION_MISMATCH, values_.span(value), std::move(message),
           std::move(help));
  } else {
    report_unlisted(path, values_.span(value), std::move(message), std::move(help));
  }
}

// An extension without a schema may add the value, unless it misspells a value of the list.
void Walker::report_unlisted(const Path& path, Span span, std::string message, std::string help) {
  const bool perhaps_added = !adding_extension_.empty() && help.empty();
  if (perhaps_added) {
    help = "use one of the listed values, unless the unknown extension " +
           quoted(adding_extension_) + " adds this one";
  }
  report(path, Code::VALUE_NOT_IN_LIST, span, std::move(message), std::move(help),
         perhaps_added ? Severity::warning : std::optional<Severity>());
}

// Declared extensions may add values to a list of core.
bool Walker::is_added(ShapeId shape, Value value) const {
  return std::any_of(tables_.additions.begin(), tables_.additions.end(), [&](const auto& addition) {
    if (addition.shape != shape) return false;
    const auto equal = [&](const Literal& literal) { return values_.equals(value, literal); };
    if (std::none_of(addition.values.begin(), addition.values.end(), equal)) return false;
    const Extension& extension = set_.extensions()[addition.extension];
    return is_declared(extension.name) && looks_into(addition.extension, extension.name);
  });
}

void Walker::check_number(ShapeId id, Value value, const Path& path) {
  const Shape& shape = set_.shape(id);
  const double number = values_.number(value).value;
  const bool is_reference = shape.ref.has_value() && values_.has_type(value, kInteger);
  const bool means_none = number < 0 && number >= shape.minimum && std::isfinite(shape.minimum);
  if (is_reference && means_none) return;
  if (is_reference && number < 0) {
    discard_reference(id);
    unset_ = true;
    report(path, Code::INVALID_INDEX, values_.span(value),
           name_of(path) + " is " + shown(values_, value) + "; it must be a non-negative integer.",
           number == -1 && may_be_absent(path) ? "remove the member" : "");
    return;
  }
  const bool low = number < shape.minimum || (shape.exclusive_minimum && number == shape.minimum);
  const bool high = number > shape.maximum || (shape.exclusive_maximum && number == shape.maximum);
  if (low || high || !std::isfinite(number)) {
    const std::string range = range_phrase(shape);
    unset_ = true;
    report(path, Code::VALUE_NOT_IN_RANGE, values_.span(value),
           name_of(path) + " is " + shown(values_, value) + "; it must be " +
               (range.empty() ? "a finite number" : range) + ".",
           range_help(shape, number, path));
    return;
  }
  // The only such case of the Khronos validator is reported by a rule after the members.
  if (shape.multiple_of != 0 && !deviations().reading_order &&
      !is_multiple(number, shape.multiple_of)) {
    report(path, Code::VALUE_MULTIPLE_OF, values_.span(value),
           name_of(path) + " is " + shown(values_, value) + "; it must be a multiple of " +
               number_text(shape.multiple_of) + ".");
  }
  if (is_reference) refer(id, static_cast<std::uint64_t>(number), value, path);
}

void Walker::check_text(ShapeId id, Value value, const Path& path) {
  const Shape& shape = set_.shape(id);
  std::string buffer;
  const std::string_view text = document_.string(value.node, buffer);
  if (shape.min_length != 0 || shape.max_length != UINT64_MAX) {
    const std::size_t length = count_code_points(text);
    if (length < shape.min_length || length > shape.max_length) {
      report(path, Code::STRING_LENGTH_NOT_IN_RANGE, values_.span(value),
             name_of(path) + " has " + std::to_string(length) + " characters; it must have " +
                 count_phrase(shape.min_length, shape.max_length, "character", "characters") + ".");
    }
  }
  if (shape.pattern != kNone && !set_.matches(shape.pattern, text)) {
    unset_ = true;
    report(path, Code::PATTERN_MISMATCH, values_.span(value),
           name_of(path) + " is " + shown(values_, value) + "; it must match " +
               std::string(set_.pattern_text(shape.pattern)) + ".");
  }
  if (shape.should_match != kNone && !set_.matches(shape.should_match, text)) {
    report(path, Code::PATTERN_MISMATCH, values_.span(value),
           name_of(path) + " is " + shown(values_, value) + "; it should match " +
               std::string(set_.pattern_text(shape.should_match)) + ".",
           {}, Severity::warning);
  }
  const bool pointer = shape.format == "json-pointer";
  if (pointer && options_.references != nullptr) {
    using Kind = ReferenceUse::Kind;
    (*options_.references)({Kind::pointer, value.node, nullptr, {}, 0, {}, json::kNoNode});
  }
  if (pointer && !is_json_pointer(text)) {
    unset_ = true;
    report(path, Code::PATTERN_MISMATCH, values_.span(value),
           name_of(path) + " is " + shown(values_, value) + "; it must be a JSON pointer.",
           "start the pointer with '/', and write ~0 for '~'");
  }
  if (shape.ref_name) refer_name(id, text, value, path);
}

}  // namespace gltfx::schema
