// SPDX-License-Identifier: Apache-2.0
// Arrays: as one node of numbers, or element by element.
#include <algorithm>
#include <cmath>
#include <unordered_set>
#include <utility>

#include "base/codes.hpp"
#include "base/number.hpp"
#include "schema/meant.hpp"
#include "schema/phrases.hpp"
#include "schema/walker.hpp"

namespace gltfx::schema {
namespace {

// Numbers seen in one array: compared one by one while they are few.
class SeenNumbers {
 public:
  bool insert(double number) {
    if (few_.size() < 16) {
      for (const double seen : few_) {
        if (seen == number) return false;
      }
      few_.push_back(number);
      return true;
    }
    if (many_.empty()) many_.insert(few_.begin(), few_.end());
    return many_.insert(number).second;
  }

 private:
  std::vector<double> few_;
  std::unordered_set<double> many_;
};

// Whether all numbers of an array's text are from 0 to 1, judged by their first digit;
// `negative` lets them be below 0 as well. False when in doubt.
bool are_fractions(std::string_view raw, bool negative) {
  for (std::size_t at = 1; at + 1 < raw.size(); ++at) {
    const char c = raw[at];
    if (c == ',' || c == ' ' || c == '\n' || c == '\r' || c == '\t') continue;
    if (c == '-') {
      if (!negative) return false;
      ++at;
    }
    const bool one = raw[at] == '1';
    if (!one && raw[at] != '0') return false;
    if (raw[at + 1] >= '0' && raw[at + 1] <= '9') return false;  // 10
    if (raw[at + 1] != '.') continue;
    at += 2;
    while (one ? raw[at] == '0' : raw[at] >= '0' && raw[at] <= '9') ++at;
    --at;
    const char next = raw[at + 1];
    if ((next >= '0' && next <= '9') || next == 'e' || next == 'E') return false;
  }
  return true;
}

bool counts(const Shape& shape) { return shape.min_items != 0 || shape.max_items != UINT64_MAX; }

}  // namespace

bool Walker::array(ShapeId id, json::NodeId node, Step step) {
  if (document_.kind(node) == json::Kind::number_array) {
    number_array(id, node, step);
    return false;
  }
  return walk(id, node, step, Mode::array);
}

void Walker::number_array(ShapeId id, json::NodeId node, Step step) {
  const Shape& shape = set_.shape(id);
  bool wrong_length = false;
  if (counts(shape)) {
    const std::uint64_t size = document_.array_size(node);
    wrong_length = size < shape.min_items || size > shape.max_items;
    if (wrong_length) count_items(shape, size, {node}, path_of(node, step));
  }
  if (wrong_length && (deviations().broken_values_are_absent || is_vector(shape))) return;
  if (shape.items != kNone) {
    const ShapePlan& items = tables_.shapes[shape.items];
    const bool in_range =
        items.every_value ||
        (items.every_fraction && are_fractions(document_.raw(node), items.every_negative_fraction));
    const bool nothing_to_see =
        in_range && !deviations().infinite_numbers_are_out_of_range && !shape.unique_items;
    const bool done = nothing_to_see || (items.plan == Plan::index &&
                                         plain_indices(shape.items, node, shape.unique_items));
    if (!done) numbers(shape.items, node, shape, step);
  } else if (shape.unique_items) {
    numbers(kNone, node, shape, step);
  }
  if (shape.unit_length != UnitLength::free) unit_length(shape, node, path_of(node, step));
  if (tables_.shapes[id].combined) combine(id, {node}, path_of(node, step), false);
}

void Walker::unit_length(const Shape& shape, json::NodeId node, const Path& path) {
  constexpr double kTolerance = 0.005;  // for programs that write three digits
  double length = 0;
  for (json::NumberCursor at(document_, node); at.valid(); at.advance()) {
    length = std::hypot(length, at.number().value);
  }
  if (!std::isfinite(length) || std::abs(length - 1) <= kTolerance) return;
  const bool must = shape.unit_length == UnitLength::error;
  report(path, Code::VECTOR_NON_UNIT, opening(node),
         name_of(path) + " has length " + number_text(length) +
             (must ? "; it must be 1." : "; it should be 1."),
         length > 0 ? "divide the numbers by the length" : "",
         must ? std::nullopt : std::optional(Severity::warning));
}

// A fixed number of plain numbers that form a vector. A wrong count is reported before ranges:
// three angles are not a quaternion with a component out of range.
bool Walker::is_vector(const Shape& shape) const {
  return shape.min_items == shape.max_items && shape.items != kNone &&
         tables_.shapes[shape.items].plan == Plan::number;
}

// The previous indices of an array: few are compared one by one, many get a stamp each.
class Walker::Repeats {
 public:
  Repeats(Walker& walker, bool wanted, std::size_t bytes, std::uint64_t size)
      : walker_(walker), wanted_(wanted), many_(bytes > 2 * kFew) {
    if (!wanted_ || !many_) return;
    if (walker_.stamps_.size() < size) walker_.stamps_.resize(size, 0);
    ++walker_.stamp_;
  }

  bool is_one(std::uint64_t index) {
    if (!wanted_) return false;
    if (many_) return std::exchange(walker_.stamps_[index], walker_.stamp_) == walker_.stamp_;
    if (std::find(few_, few_ + count_, index) != few_ + count_) return true;
    few_[count_++] = index;
    return false;
  }

 private:
  static constexpr std::size_t kFew = 64;  // an index takes two bytes or more
  Walker& walker_;
  bool wanted_, many_;
  std::uint64_t few_[kFew + 1];
  std::size_t count_ = 0;
};

// Fast path for arrays of valid indices: marks them as used. False: the array needs the full check.
bool Walker::plain_indices(ShapeId items, json::NodeId node, bool unique) {
  const ShapePlan& plan = tables_.shapes[items];
  const TargetPlan& target = tables_.targets[plan.target];
  if (target.pointer.empty() || target.steps_over || options_.references != nullptr) return false;
  ReferenceTargets::Array& array = targets_.from_root(plan.target);
  if (!array.holes.empty()) return false;
  const std::string_view raw = document_.raw(node);
  Repeats repeats(*this, unique, raw.size(), array.size);
  std::uint64_t number = 0;
  bool in_number = false;
  for (std::size_t i = 1; i < raw.size(); ++i) {
    const unsigned digit = static_cast<unsigned char>(raw[i]) - unsigned{'0'};
    if (digit <= 9) {
      number = number * 10 + digit;
      in_number = true;
      if (number >= array.size) return false;
      continue;
    }
    const bool separates = raw[i] == ',' || raw[i] == ']' || raw[i] == ' ' || raw[i] == '\n' ||
                           raw[i] == '\r' || raw[i] == '\t';
    if (!separates) return false;
    if (!in_number) continue;
    if (repeats.is_one(number)) return false;
    array.used.mark(number, plan.of_extension);
    number = 0;
    in_number = false;
  }
  return true;
}

void Walker::numbers(ShapeId items, json::NodeId node, const Shape& shape, Step step) {
  const Path path = path_of(node, step);
  const bool simple = items != kNone && tables_.shapes[items].plan == Plan::number;
  SeenNumbers seen;
  std::uint64_t index = 0;
  bool reported = false;
  for (json::NumberCursor at(document_, node); at.valid(); at.advance(), ++index) {
    const double number = at.number().value;
    const Value value{node, &at.number()};
    if (simple) {
      const ShapePlan& plan = tables_.shapes[items];
      if (!(number >= plan.low && number <= plan.high && std::isfinite(number)))
        check(items, value, {path, index});
    } else if (items != kNone) {
      if (bad_element(items, value, path, index, reported)) continue;
      check(items, value, {path, index});
    }
    if (shape.unique_items && !seen.insert(number)) {
      report({path, index}, Code::DUPLICATE_ELEMENTS, at.number().span,
             name_of(path) + " has " + shown(values_, value) +
                 " more than once; the elements must be unique.");
    }
  }
}

void Walker::count_items(const Shape& shape, std::uint64_t size, Value value, const Path& path) {
  unset_ = true;
  if (size == 0) {
    report(path, Code::EMPTY_ENTITY, values_.span(value),
           name_of(path) + " is an empty array; it must " +
               (shape.min_items == 1 ? std::string("not be empty")
                                     : "have " + count_phrase(shape.min_items, shape.max_items,
                                                              "element", "elements")) +
               ".",
           path.parent() != nullptr && shape.min_items == 1 ? "remove the member" : "");
    return;
  }
  const std::string meant = with_decimal_points(document_, value.node, shape);
  report(path, Code::ARRAY_LENGTH_NOT_IN_LIST, values_.span(value),
         name_of(path) + " has " + std::to_string(size) + (size == 1 ? " element" : " elements") +
             "; it must have " +
             count_phrase(shape.min_items, shape.max_items, "element", "elements") + ".",
         meant.empty() ? "" : "write decimal points: " + meant);
}

void Walker::array_step(Frame& frame) {
  const Shape& shape = set_.shape(frame.shape);
  unset_ = false;
  if (frame.stage == Stage::enter) {
    frame.stage = Stage::properties;
    if (counts(shape)) {
      const std::uint64_t size = count_elements(shape, frame.node);
      if (size < shape.min_items || size > shape.max_items) {
        count_items(shape, document_.array_size(frame.node), {frame.node}, frame.path);
        if (deviations().broken_values_are_absent) frame.at = document_.next(frame.node);
      }
    }
    if (shape.unique_items) unique_items(frame);
    if (invalid_elements(frame)) frame.at = document_.next(frame.node);
    frame.unset = unset_;
  }
  const json::NodeId end = document_.next(frame.node);
  bool reported = false;
  while (shape.items != kNone && frame.at < end) {
    const json::NodeId element = frame.at;
    const std::uint64_t index = frame.index++;
    frame.at = document_.next(element);
    const bool plain =
        tables_.shapes[shape.items].plan == Plan::object && document_.is_object(element);
    const bool bad = !plain && bad_element(shape.items, {element}, frame.path, index, reported);
    const bool pushed = !bad && value(shape.items, element, {Step::Kind::element, index});
    frame.unset = frame.unset || unset_;
    if (pushed) return;
  }
  if (!frame.constrained) {
    frame.constrained = true;
    constraints(frame);
  }
  if (!pending_shapes(frame)) pop();
}

// The Khronos validator does not check a list of objects any further if an element is not an
// object.
bool Walker::invalid_elements(Frame& frame) {
  if (!deviations().broken_values_are_absent) return false;
  const ShapeId items = set_.shape(frame.shape).items;
  const bool in_root = frame.parent != nullptr && frame.parent->parent == nullptr;
  if (items == kNone || in_root || tables_.shapes[items].plan != Plan::object) return false;
  if (tables_.shapes[items].type == kNone) return false;
  bool error = false, reported = false;
  std::uint64_t index = 0;
  for (const json::NodeId element : document_.elements(frame.node)) {
    const std::uint64_t at = index++;
    if (document_.is_object(element)) continue;
    error = bad_element(items, {element}, frame.path, at, reported) || error;
  }
  return error;
}

// The number of elements, counted only as far as the limits require.
std::uint64_t Walker::count_elements(const Shape& shape, json::NodeId node) const {
  const std::uint64_t enough =
      shape.max_items == UINT64_MAX ? shape.min_items : shape.max_items + 1;
  const json::NodeId end = document_.next(node);
  std::uint64_t count = 0;
  for (json::NodeId at = node + 1; at < end && count < enough; at = document_.next(at)) ++count;
  return count;
}

// Elements that are equal as text: strings with escapes are compared unescaped. Those of a wrong
// type are reported as such.
void Walker::unique_items(const Frame& frame) {
  const ShapeId items = set_.shape(frame.shape).items;
  json::KeyTable seen;
  std::uint64_t index = 0;
  for (const json::NodeId element : document_.elements(frame.node)) {
    if (items != kNone && !values_.has_type({element}, set_.shape(items).types)) {
      ++index;
      continue;
    }
    std::string unescaped;
    if (document_.is_string(element)) document_.string(element, unescaped);
    const bool is_new = unescaped.empty() ? seen.insert(document_.raw(element))
                                          : seen.insert_copy('"' + unescaped + '"');
    if (!is_new) {
      report({frame.path, index}, Code::DUPLICATE_ELEMENTS, document_.span(element),
             name_of(frame.path) + " has " + shown(values_, {element}) +
                 " more than once; the elements must be unique.");
    }
    ++index;
  }
}

// A value that should be an index, but is not.
bool Walker::bad_index(ShapeId id, Value value, const Path& path) {
  if (id == kNone) return false;
  const Shape& shape = set_.shape(id);
  if (!shape.ref || shape.types != kInteger) return false;
  if (values_.has_type(value, kInteger) && values_.number(value).value >= 0) return false;
  discard_reference(id);
  report(path, Code::INVALID_INDEX, values_.span(value),
         name_of(path) + " is " + shown(values_, value) + "; it must be a non-negative integer.");
  return true;
}

// Reports an element of the wrong type: numbers, flags and objects once at the array; indices,
// strings and arrays at the element.
bool Walker::bad_element(ShapeId items, Value value, const Path& array, std::uint64_t index,
                         bool& reported) {
  if (bad_index(items, value, {array, index})) return true;
  const Shape& shape = set_.shape(items);
  if (values_.has_type(value, shape.types)) return false;
  const bool is_root_array =
      array.parent() != nullptr && array.parent()->parent() == nullptr && !array.is_index();
  const bool at_element = (shape.types & (kString | kArray)) != 0;
  const std::string message = name_of({array, index}) + " is " + shown(values_, value) +
                              "; it must be " + type_phrase(shape.types) + ".";
  const std::string help = type_help(set_, values_, shape, value, false);
  if (shape.types == kObject && is_root_array) {
    report({array, index}, Code::TYPE_MISMATCH, values_.span(value), message, help);
  } else if (at_element) {
    unset_ = true;
    report({array, index}, Code::ARRAY_TYPE_MISMATCH, values_.span(value), message, help);
  } else if (deviations().each_finding_is_listed || !reported) {
    reported = unset_ = true;
    report(array, Code::ARRAY_TYPE_MISMATCH, values_.span(value), message, help);
  }
  return true;
}

}  // namespace gltfx::schema
