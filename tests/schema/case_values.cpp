// SPDX-License-Identifier: Apache-2.0
#include "schema/case_values.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "json/parse.hpp"
#include "schema/holds.hpp"

namespace gltfx::test {
namespace {

using schema::kNone;
using schema::Shape;
using schema::ShapeId;

constexpr std::array<const char*, 15> kWords{
    "POSITION", "a",  "TRANSLATION", "2.0",       "_A",   "KHR_x",     "/a",
    "a/b",      "ab", "1",           "video/mp4", "GEOD", "https://a", "https://vrm.dev/a",
    "1.0.0"};

Json from_literal(const schema::Literal& literal) {
  switch (literal.kind) {
    case schema::Literal::Kind::null:
      return nullptr;
    case schema::Literal::Kind::boolean:
      return literal.number != 0;
    case schema::Literal::Kind::string:
      return literal.string;
    case schema::Literal::Kind::number:
      break;
  }
  const bool whole = literal.number == std::floor(literal.number);
  return whole ? Json(static_cast<std::int64_t>(literal.number)) : Json(literal.number);
}

// A number inside the limits, away from them where there is room.
double inner(const Shape& shape) {
  const bool low = std::isfinite(shape.minimum);
  const bool high = std::isfinite(shape.maximum);
  if (low && high) return (shape.minimum + shape.maximum) / 2;
  if (low) return shape.exclusive_minimum || shape.minimum == 0 ? shape.minimum + 1 : shape.minimum;
  return high ? shape.maximum - 1 : 1;
}

bool is_alternative(const Shape& shape) { return !shape.any_of.empty() || !shape.one_of.empty(); }

}  // namespace

Json ValueMaker::make(ShapeId id, const std::string& pointer, std::vector<Need>& needs) {
  if (id == kNone) return "anything";
  const Shape& shape = set_.shape(id);
  if (!shape.literals.empty()) return from_literal(shape.literals.front());
  const bool open = shape.types == 0 && shape.type == kNone && is_alternative(shape);
  if (open)
    return make(shape.any_of.empty() ? shape.one_of.front() : shape.any_of.front(), pointer, needs);
  if ((shape.types & (schema::kNumber | schema::kInteger)) != 0)
    return make_number(shape, pointer, needs);
  if ((shape.types & schema::kString) != 0) return make_string(shape, pointer, needs);
  if ((shape.types & schema::kBoolean) != 0) return true;
  if ((shape.types & schema::kArray) != 0) return make_array(shape, pointer, needs);
  if ((shape.types & schema::kNull) != 0) return nullptr;
  Json object = Json::object();
  complete(id, object, pointer, needs);
  return object;
}

Json ValueMaker::make_number(const Shape& shape, const std::string& pointer,
                             std::vector<Need>& needs) {
  if (shape.ref) {
    need(*shape.ref, pointer, false, needs);
    needs.back().has = shape.ref_has;
    return 0;
  }
  double value = inner(shape);
  // Twelve is a multiple of all numbers in conditions.
  const bool integer = (shape.types & schema::kNumber) == 0;
  if (integer) value = shape.minimum <= 12 && shape.maximum >= 12 ? 12 : std::ceil(value);
  if (shape.multiple_of != 0) value = std::ceil(value / shape.multiple_of) * shape.multiple_of;
  if (value == std::floor(value)) return static_cast<std::int64_t>(value);
  return value;
}

Json ValueMaker::make_string(const Shape& shape, const std::string& pointer,
                             std::vector<Need>& needs) {
  if (shape.ref_name) need(*shape.ref_name, pointer, true, needs);
  if (shape.format == "json-pointer") return "/nodes/0/translation";
  for (const char* word : kWords) {
    std::string text(word);
    while (text.size() < shape.min_length) text += 'a';
    const auto fits = [&](std::uint32_t pattern) {
      return pattern == kNone || set_.matches(pattern, text);
    };
    const bool matches = fits(shape.pattern) && fits(shape.should_match);
    if (matches && text.size() <= shape.max_length) return text;
  }
  return "no word fits";
}

Json ValueMaker::make_array(const Shape& shape, const std::string& pointer,
                            std::vector<Need>& needs) {
  Json array = Json::array();
  const std::uint64_t size = std::max<std::uint64_t>(shape.min_items, 1);
  for (std::uint64_t i = 0; i < size; ++i) {
    array.push_back(make(shape.items, pointer + "/" + std::to_string(i), needs));
    if (shape.unique_items && i > 0 && array[i].is_number()) array[i] = i;
    if (shape.unit_length != schema::UnitLength::free) array[i] = i == 0 ? 1 : 0;
  }
  return array;
}

void ValueMaker::complete(ShapeId id, Json& object, const std::string& pointer,
                          std::vector<Need>& needs) {
  const Shape& shape = set_.shape(id);
  const std::size_t around = open_.size();
  if (shape.type != kNone) open_.push_back({set_.type(shape.type).origin, pointer});
  complete_members(shape, object, pointer, needs);
  complete_branches(shape, object, pointer, needs);
  complete_dependencies(shape, object, pointer, needs);
  open_.resize(around, {kNone, {}});
}

void ValueMaker::complete_members(const Shape& shape, Json& object, const std::string& pointer,
                                  std::vector<Need>& needs) {
  if (shape.type != kNone) {
    for (const schema::Property& property : set_.type(shape.type).properties) {
      const std::string at = pointer + "/" + property.name;
      if (property.required && !object.contains(property.name)) {
        object[property.name] = make(property.shape, at, needs);
      } else if (property.shape != kNone && object.contains(property.name) &&
                 object[property.name].is_object()) {
        complete(property.shape, object[property.name], at, needs);
      }
    }
  }
  while (shape.values != kNone && object.size() < shape.min_properties) {
    const std::string name = member_name(shape, object);
    object[name] = make(shape.values, pointer + "/" + name, needs);
  }
}

// Members that branches require get the value that the object's own type describes.
void ValueMaker::complete_branches(const Shape& shape, Json& object, const std::string& pointer,
                                   std::vector<Need>& needs) {
  const auto add = [&](ShapeId branch) {
    if (branch == kNone) return;
    if (shape.type != kNone && set_.shape(branch).type != kNone) {
      for (const schema::Property& wanted : set_.type(set_.shape(branch).type).properties) {
        const schema::Property* own = set_.find_property(shape.type, wanted.name);
        const bool is_choice = wanted.shape != kNone && !set_.shape(wanted.shape).literals.empty();
        if (is_choice && object.contains(wanted.name) &&
            !holds(wanted.shape, object[wanted.name])) {
          object[wanted.name] = from_literal(set_.shape(wanted.shape).literals.front());
        }
        if (!wanted.required || wanted.shape != kNone || own == nullptr ||
            object.contains(wanted.name))
          continue;
        object[wanted.name] = make(own->shape, pointer + "/" + wanted.name, needs);
      }
    }
    complete(branch, object, pointer, needs);
  };
  // Conditions inside them speak of the members of this object.
  for (const ShapeId all : shape.all_of) {
    if (all == kNone) continue;
    for (const schema::Condition& condition : set_.shape(all).conditions) {
      add(holds(condition.if_shape, object) ? condition.then_shape : condition.else_shape);
    }
  }
  for (const ShapeId all : shape.all_of) add(all);
  for (const schema::Condition& condition : shape.conditions) {
    add(holds(condition.if_shape, object) ? condition.then_shape : condition.else_shape);
  }
  for (const auto* branches : {&shape.any_of, &shape.one_of}) {
    const auto fits = [&](ShapeId branch) { return holds(branch, object); };
    if (!branches->empty() && std::none_of(branches->begin(), branches->end(), fits)) {
      add(nearest_branch(*branches, object));
    }
  }
}

// The alternative with the most existing members.
ShapeId ValueMaker::nearest_branch(const std::vector<ShapeId>& branches, const Json& object) const {
  const auto there = [&](ShapeId branch) {
    std::size_t count = 0;
    if (branch == kNone || set_.shape(branch).type == kNone) return count;
    for (const schema::Property& property : set_.type(set_.shape(branch).type).properties) {
      count += object.contains(property.name) ? 1U : 0U;
    }
    return count;
  };
  return *std::max_element(branches.begin(), branches.end(),
                           [&](ShapeId a, ShapeId b) { return there(a) < there(b); });
}

void ValueMaker::complete_dependencies(const Shape& shape, Json& object, const std::string& pointer,
                                       std::vector<Need>& needs) {
  // Added members may need others.
  for (bool more = true; more;) {
    more = false;
    for (const auto& [name, others] : shape.dependent_required) {
      if (!object.contains(name)) continue;
      for (const std::string& other : others) {
        const schema::Property* property = set_.find_property(shape.type, other);
        if (object.contains(other) || property == nullptr) continue;
        object[other] = make(property->shape, pointer + "/" + other, needs);
        more = true;
      }
    }
  }
}

std::string ValueMaker::member_name(const Shape& shape, const Json& object) const {
  for (const char* word : kWords) {
    const std::uint32_t pattern =
        shape.property_names == kNone ? kNone : set_.shape(shape.property_names).pattern;
    if (!object.contains(word) && (pattern == kNone || set_.matches(pattern, word))) return word;
  }
  return "no name fits";
}

void ValueMaker::need(const schema::Target& target, const std::string& pointer, bool is_name,
                      std::vector<Need>& needs) {
  std::string from;
  if (target.base == schema::Target::Base::enclosing) {
    for (const Around& open : open_) {
      if (open.origin == target.enclosing) from = open.pointer;
    }
  }
  needs.push_back({from, target, pointer, is_name});
}

bool ValueMaker::holds(ShapeId shape, const Json& value) const {
  const json::Parsed parsed = json::parse(value.dump());
  schema::DocumentNames names(parsed.document, set_);
  schema::Holds quiet(parsed.document, set_, names);
  return quiet(shape, {parsed.document.root()});
}

}  // namespace gltfx::test
