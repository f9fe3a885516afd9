// SPDX-License-Identifier: Apache-2.0
#include "schema/phrases.hpp"

#include <algorithm>
#include <cmath>

#include "base/number.hpp"
#include "base/text.hpp"
#include "schema/meant.hpp"

namespace gltfx::schema {
namespace {

constexpr std::size_t kShown = 40;  // code points of a value that a message repeats

std::string literal_text(const Literal& literal) {
  switch (literal.kind) {
    case Literal::Kind::null:
      return "null";
    case Literal::Kind::boolean:
      return literal.number != 0 ? "true" : "false";
    case Literal::Kind::string:
      return quoted(literal.string, kShown);
    case Literal::Kind::number:
      break;
  }
  const std::string number = number_text(literal.number);
  return literal.name.empty() ? number : number + " (" + literal.name + ")";
}

// The allowed values as JSON text.
std::string json_literals(const Shape& shape) {
  std::vector<std::string> texts;
  for (const Literal& literal : shape.literals) {
    texts.push_back(literal.kind == Literal::Kind::string ? "\"" + literal.string + "\""
                                                          : literal_text(literal));
  }
  return join_or(texts);
}

// Help for a single value in place of an array of a fixed size.
std::string array_help(const Shape& shape, const std::string& value) {
  constexpr std::uint64_t kMost = 4;
  if (shape.min_items > kMost) return {};
  std::string text = "write [" + value;
  for (std::uint64_t i = 1; i < shape.min_items; ++i) text += ", " + value;
  return text + "]";
}

}  // namespace

std::string name_of(const Path& path) {
  if (path.parent() == nullptr) return "The document";
  if (!path.is_index()) return quoted(path.key(), kShown);
  const std::string element = "Element " + std::to_string(path.index());
  const Path* array = path.parent();
  while (array->parent() != nullptr && array->is_index()) array = array->parent();
  return array->parent() == nullptr ? element : element + " of " + quoted(array->key(), kShown);
}

std::string shown(const Values& values, Value value) {
  switch (values.kind(value)) {
    case json::Kind::array:
    case json::Kind::number_array:
      return "an array";
    case json::Kind::object:
      return "an object";
    case json::Kind::string:
      return "the string " + quoted(values.document.string(value.node), kShown);
    default:
      break;
  }
  const std::string_view raw = values.raw(value);
  const std::string text = printable(raw.substr(0, kShown));
  return raw.size() > kShown ? text + "…" : text;
}

std::string type_phrase(std::uint8_t types) {
  constexpr std::pair<TypeBit, const char*> kNames[]{
      {kObject, "an object"}, {kArray, "an array"},     {kString, "a string"},
      {kNumber, "a number"},  {kInteger, "an integer"}, {kBoolean, "true or false"},
      {kNull, "null"}};
  std::vector<std::string> names;
  for (const auto& [bit, name] : kNames) {
    const bool named = bit == kInteger && (types & kNumber) != 0;
    if ((types & bit) != 0 && !named) names.emplace_back(name);
  }
  return join_or(names);
}

std::string range_phrase(const Shape& shape) {
  const bool low = std::isfinite(shape.minimum);
  const bool high = std::isfinite(shape.maximum);
  if (low && high && !shape.exclusive_minimum && !shape.exclusive_maximum) {
    if (shape.minimum == shape.maximum) return number_text(shape.minimum);
    return "between " + number_text(shape.minimum) + " and " + number_text(shape.maximum);
  }
  std::string text;
  if (low) text = (shape.exclusive_minimum ? "above " : "at least ") + number_text(shape.minimum);
  if (high) {
    if (low) text += " and ";
    text += (shape.exclusive_maximum ? "below " : "at most ") + number_text(shape.maximum);
  }
  return text;
}

std::string list_phrase(const Shape& shape) {
  std::vector<std::string> values;
  for (const Literal& literal : shape.literals) values.push_back(literal_text(literal));
  return join_or(values, 12);
}

std::string count_phrase(std::uint64_t least, std::uint64_t most, const char* one,
                         const char* many) {
  const auto things = [&](std::uint64_t n) {
    return std::to_string(n) + " " + (n == 1 ? one : many);
  };
  if (least == most) return "exactly " + things(least);
  if (most == UINT64_MAX) return "at least " + things(least);
  if (least == 0) return "at most " + things(most);
  return std::to_string(least) + " to " + things(most);
}

std::string scalar_phrase(const Set& set, const Shape& shape) {
  if (!shape.literals.empty()) return list_phrase(shape);
  std::string range = range_phrase(shape);
  if (!range.empty()) return range;
  if (shape.pattern != kNone)
    return "a string that matches " + std::string(set.pattern_text(shape.pattern));
  return shape.types != 0 ? type_phrase(shape.types) : std::string("another value");
}

std::string clause(std::string text) {
  const bool word = text.size() > 1 && (text[1] == ' ' || (text[1] >= 'a' && text[1] <= 'z'));
  if (word && text[0] >= 'A' && text[0] <= 'Z') text[0] = static_cast<char>(text[0] - 'A' + 'a');
  return text;
}

std::string all_of_phrase(const std::vector<std::string>& names) {
  std::vector<std::string> items;
  items.reserve(names.size());
  for (const std::string& name : names) items.push_back(quoted(name));
  return join_and(items);
}

std::string type_help(const Set& set, const Values& values, const Shape& shape, Value value,
                      bool optional) {
  const json::Kind kind = values.kind(value);
  const bool text = kind == json::Kind::string;
  const std::string meant = meant_value(set, values, shape, value);
  if (!meant.empty()) return (text ? "remove the quotes: write " : "write ") + meant;
  if (text) return {};
  if (kind == json::Kind::null && optional) return "remove the member";
  const std::string raw(values.raw(value).substr(0, kShown));
  if (shape.types == kArray && shape.items != kNone) {
    const std::uint8_t items = set.shape(shape.items).types;
    if (kind == json::Kind::object && (items & kObject) != 0)
      return "write an array of objects: [ { … } ]";
    if (items != 0 && kind != json::Kind::object && values.has_type(value, items))
      return array_help(shape, raw);
  }
  return shape.hint;
}

std::string missing_help(const Set& set, const Property& property) {
  std::string add = "add \"" + property.name + "\"";
  if (property.shape == kNone) return add;
  const Shape& shape = set.shape(property.shape);
  if (!shape.hint.empty()) return shape.hint;
  if (!shape.literals.empty()) return add + ": " + json_literals(shape);
  if (!property.default_json.empty()) return add + ": " + property.default_json;
  if (shape.types == 0) return add;
  const std::string range = range_phrase(shape);
  return add + ", " + type_phrase(shape.types) + (range.empty() ? "" : " " + range);
}

}  // namespace gltfx::schema
