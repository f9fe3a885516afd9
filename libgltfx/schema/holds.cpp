// SPDX-License-Identifier: Apache-2.0
#include "schema/holds.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "base/text.hpp"

namespace gltfx::schema {

bool is_multiple(double number, double of) {
  if (std::trunc(number) == number && std::trunc(of) == of) return std::fmod(number, of) == 0;
  const double quotient = number / of;
  // Both decimals and the division are rounded.
  constexpr double kRounding = 4 * std::numeric_limits<double>::epsilon();
  return std::isfinite(quotient) && std::fabs(quotient - std::round(quotient)) <=
                                        kRounding * std::max(1.0, std::fabs(quotient));
}

bool Holds::holds(ShapeId id, Value value, int depth) {
  if (id == kNone || depth > kDepth) return true;
  const json::Kind kind = values_.kind(value);
  const bool container = kind == json::Kind::object || kind == json::Kind::array;
  // Shallow shapes are fast to check again and not cached.
  if (!container || set_.walk_tables().shapes[id].shallow) {
    return check(set_.shape(id), value, depth);
  }
  const std::uint64_t key = (std::uint64_t{id} << 32) | value.node;
  const auto known = known_.find(key);
  if (known != known_.end()) return known->second;
  const bool answer = check(set_.shape(id), value, depth);
  known_.emplace(key, answer);
  return answer;
}

bool Holds::check(const Shape& shape, Value value, int depth) {
  if (shape.never || !values_.has_type(value, shape.types)) return false;
  const auto equal = [&](const Literal& literal) { return values_.equals(value, literal); };
  if (!shape.literals.empty() &&
      std::none_of(shape.literals.begin(), shape.literals.end(), equal)) {
    return false;
  }
  switch (values_.kind(value)) {
    case json::Kind::number:
      if (!number(shape, value)) return false;
      break;
    case json::Kind::string:
      if (!text(shape, value)) return false;
      break;
    case json::Kind::array:
    case json::Kind::number_array:
      if (!array(shape, value.node, depth)) return false;
      break;
    case json::Kind::object:
      if (!object(shape, value.node, depth)) return false;
      break;
    default:
      break;
  }
  return combinators(shape, value, depth);
}

bool Holds::combinators(const Shape& shape, Value value, int depth) {
  const auto fits = [&](ShapeId id) { return holds(id, value, depth); };
  if (!std::all_of(shape.all_of.begin(), shape.all_of.end(), fits)) return false;
  if (!shape.any_of.empty() && std::none_of(shape.any_of.begin(), shape.any_of.end(), fits))
    return false;
  if (!shape.one_of.empty() && std::count_if(shape.one_of.begin(), shape.one_of.end(), fits) != 1)
    return false;
  if (shape.not_shape != kNone && fits(shape.not_shape)) return false;
  return std::all_of(
      shape.conditions.begin(), shape.conditions.end(), [&](const Condition& condition) {
        return fits(fits(condition.if_shape) ? condition.then_shape : condition.else_shape);
      });
}

bool Holds::number(const Shape& shape, Value value) const {
  const double number = values_.number(value).value;
  if (number < shape.minimum || number > shape.maximum) return false;
  if (shape.exclusive_minimum && number == shape.minimum) return false;
  if (shape.exclusive_maximum && number == shape.maximum) return false;
  return shape.multiple_of == 0 || is_multiple(number, shape.multiple_of);
}

bool Holds::text(const Shape& shape, Value value) const {
  std::string buffer;
  const std::string_view text = values_.document.string(value.node, buffer);
  if (shape.min_length != 0 || shape.max_length != UINT64_MAX) {
    const std::size_t length = count_code_points(text);
    if (length < shape.min_length || length > shape.max_length) return false;
  }
  return shape.pattern == kNone || set_.matches(shape.pattern, text);
}

bool Holds::array(const Shape& shape, json::NodeId node, int depth) {
  if (shape.min_items != 0 || shape.max_items != UINT64_MAX) {
    const std::size_t size = values_.document.array_size(node);
    if (size < shape.min_items || size > shape.max_items) return false;
  }
  if (shape.items == kNone) return true;
  if (values_.document.kind(node) == json::Kind::number_array) {
    for (json::NumberCursor at(values_.document, node); at.valid(); at.advance()) {
      if (!holds(shape.items, {node, &at.number()}, depth + 1)) return false;
    }
    return true;
  }
  for (const json::NodeId element : values_.document.elements(node)) {
    if (!holds(shape.items, {element}, depth + 1)) return false;
  }
  return true;
}

bool Holds::object(const Shape& shape, json::NodeId node, int depth) {
  const json::Document& document = values_.document;
  if (shape.min_properties != 0 || shape.max_properties != UINT64_MAX) {
    const std::size_t size = document.object_size(node);
    if (size < shape.min_properties || size > shape.max_properties) return false;
  }
  if (!members(shape, node, depth)) return false;
  const auto is_there = [&](const std::string& name) {
    return document.find(node, name) != json::kNoNode;
  };
  return std::all_of(shape.dependent_required.begin(), shape.dependent_required.end(),
                     [&](const auto& rule) {
                       return !is_there(rule.first) ||
                              std::all_of(rule.second.begin(), rule.second.end(), is_there);
                     });
}

bool Holds::members(const Shape& shape, json::NodeId node, int depth) {
  const json::Document& document = values_.document;
  const ObjectType* type = shape.type == kNone ? nullptr : &set_.type(shape.type);
  // Most types have a few dozen properties at most: no allocation for each object.
  fmt::basic_memory_buffer<json::NodeId, 64> values;
  values.resize(type == nullptr ? 0 : type->properties.size());
  std::fill(values.begin(), values.end(), json::kNoNode);
  const bool others = shape.values != kNone || !shape.pattern_properties.empty() ||
                      (type != nullptr && type->strict);
  if (type == nullptr && !others) return true;
  for (const auto& member : document.members(node)) {
    const Symbol symbol = names_.symbol(member.key_id);
    const TypePlan::Entry* entry = type == nullptr || symbol == kNone
                                       ? nullptr
                                       : set_.walk_tables().types[shape.type].find(symbol);
    if (entry != nullptr && !entry->alias) {
      values[entry->property] = member.value;
    } else if (others && !other_member(shape, document.key(member.key_id), member.value, depth)) {
      return false;
    }
  }
  for (std::size_t i = 0; i < values.size(); ++i) {
    const Property& property = type->properties[i];
    const bool fits = values[i] == json::kNoNode ? !property.required
                                                 : holds(property.shape, {values[i]}, depth + 1);
    if (!fits) return false;
  }
  return true;
}

bool Holds::other_member(const Shape& shape, std::string_view name, json::NodeId value, int depth) {
  bool matched = false;
  for (const auto& [pattern, inside] : shape.pattern_properties) {
    if (!set_.matches(pattern, name)) continue;
    matched = true;
    if (!holds(inside, {value}, depth + 1)) return false;
  }
  if (matched) return true;
  if (shape.values != kNone) return holds(shape.values, {value}, depth + 1);
  const bool common = name == "extensions" || name == "extras";
  return common || shape.type == kNone || !set_.type(shape.type).strict;
}

}  // namespace gltfx::schema
