// SPDX-License-Identifier: Apache-2.0
// Reads keywords into a Shape.
#include <algorithm>
#include <cstdlib>

#include "schema/shape_builder.hpp"
#include "schema/value.hpp"

namespace gltfx::schema {
void ShapeBuilder::read_keyword(Keyword keyword, Site value, const Where& where, Shape& shape,
                                Members& members) {
  switch (keyword) {
    case Keyword::properties:
      members.properties = value;
      return;
    case Keyword::required:
      members.required = value;
      return;
    case Keyword::additional_properties:
      members.additional = value;
      return;
    case Keyword::x_gltfx:
      members.annotation = value;
      return;
    case Keyword::type:
      for (const std::string& name : read_names(build_, value)) shape.types |= type_bit(name);
      return;
    case Keyword::enumeration:
      shape.literals = read_literals(build_, value);
      return;
    case Keyword::constant:
      shape.literals = {read_literal(build_.document(value), value.node)};
      shape.is_const = true;
      return;
    case Keyword::items:
      shape.items = request(value, where);
      return;
    case Keyword::property_names:
      shape.property_names = request(value, where);
      return;
    case Keyword::pattern_properties:
      for (const auto& member : build_.document(value).members(value.node)) {
        const std::uint32_t expression = pattern(build_.document(value).key(member.key_id));
        shape.pattern_properties.emplace_back(expression,
                                              request({value.source, member.value}, where));
      }
      return;
    case Keyword::dependent_required:
      for (const auto& member : build_.document(value).members(value.node)) {
        shape.dependent_required.emplace_back(build_.document(value).key(member.key_id),
                                              read_names(build_, {value.source, member.value}));
      }
      return;
    case Keyword::all_of:
    case Keyword::any_of:
    case Keyword::one_of:
    case Keyword::not_:
    case Keyword::if_:
    case Keyword::then_:
    case Keyword::else_:
      return read_branches(keyword, value, where, shape);
    default:
      return read_scalar(keyword, value, shape);
  }
}

void ShapeBuilder::read_scalar(Keyword keyword, Site value, Shape& shape) {
  const json::Document& document = build_.document(value);
  const auto number = [&] { return document.number(value.node).value; };
  const auto count = [&] { return document.unsigned_integer(value.node).value_or(0); };
  switch (keyword) {
    case Keyword::title:
      shape.title = build_.text(value);
      break;
    case Keyword::description:
      shape.description = build_.text(value);
      break;
    case Keyword::format:
      shape.format = build_.text(value);
      break;
    case Keyword::pattern:
      shape.pattern = pattern(build_.text(value));
      break;
    case Keyword::minimum:
      if (number() > shape.minimum) shape.exclusive_minimum = false;
      shape.minimum = std::max(shape.minimum, number());
      break;
    case Keyword::maximum:
      if (number() < shape.maximum) shape.exclusive_maximum = false;
      shape.maximum = std::min(shape.maximum, number());
      break;
    case Keyword::exclusive_minimum:
      shape.exclusive_minimum |= number() >= shape.minimum;
      shape.minimum = std::max(shape.minimum, number());
      break;
    case Keyword::exclusive_maximum:
      shape.exclusive_maximum |= number() <= shape.maximum;
      shape.maximum = std::min(shape.maximum, number());
      break;
    case Keyword::multiple_of:
      shape.multiple_of = number();
      break;
    case Keyword::min_length:
      shape.min_length = count();
      break;
    case Keyword::max_length:
      shape.max_length = count();
      break;
    case Keyword::min_items:
      shape.min_items = count();
      break;
    case Keyword::max_items:
      shape.max_items = count();
      break;
    case Keyword::min_properties:
      shape.min_properties = count();
      break;
    case Keyword::max_properties:
      shape.max_properties = count();
      break;
    case Keyword::unique_items:
      shape.unique_items = document.kind(value.node) == json::Kind::true_value;
      break;
    default:
      break;
  }
}

void ShapeBuilder::read_branches(Keyword keyword, Site value, const Where& where, Shape& shape) {
  const Where inside{where.type_name, where.label, true};
  const auto one = [&] { return request(value, inside); };
  const auto each = [&](std::vector<ShapeId>& list) {
    for (const json::NodeId branch : build_.document(value).elements(value.node)) {
      const ShapeId shape_id = request({value.source, branch}, inside);
      list.push_back(shape_id == kNone ? any_shape() : shape_id);
    }
  };
  // Two of the three may come before `if`: they share one condition.
  const auto condition = [&]() -> Condition& {
    if (shape.conditions.empty()) shape.conditions.emplace_back();
    return shape.conditions.front();
  };
  switch (keyword) {
    case Keyword::all_of:
      return each(shape.all_of);
    case Keyword::any_of:
      return each(shape.any_of);
    case Keyword::one_of:
      return each(shape.one_of);
    case Keyword::not_:
      shape.not_shape = one();
      if (shape.not_shape == kNone) shape.never = true;  // `not` of everything allows nothing
      return;
    case Keyword::if_:
      condition().if_shape = one();
      return;
    case Keyword::then_:
      condition().then_shape = one();
      return;
    default:
      condition().else_shape = one();
      return;
  }
}

void ShapeBuilder::read_annotation(Site annotation, const Where& where, Shape& shape) {
  const auto word = [&](std::string_view name) { return build_.member(annotation, name); };
  if (const Site hint = word("hint"); hint.exists()) shape.hint = build_.text(hint);
  if (const Site hint = word("zeroHint"); hint.exists()) shape.zero_hint = build_.text(hint);
  if (const Site ref = word("ref"); ref.exists()) shape.ref = read_target(build_, ref);
  if (const Site has = word("refHas"); has.exists()) shape.ref_has = split_steps(build_.text(has));
  if (const Site holds = word("refHolds"); holds.exists()) {
    shape.ref_holds = request(holds, {where.type_name, where.label, true});
  }
  if (const Site since = word("openSince"); since.exists()) {
    shape.open_since = read_version(build_, since);
  }
  if (const Site name = word("refName"); name.exists()) shape.ref_name = read_target(build_, name);
  if (const Site unit = word("unitLength"); unit.exists()) {
    shape.unit_length = build_.text(unit) == "error" ? UnitLength::error : UnitLength::warning;
  }
  if (const Site text = word("shouldMatch"); text.exists()) {
    shape.should_match = pattern(build_.text(text));
  }
  if (const Site ref = word("mayRefer"); ref.exists()) shape.may_refer = read_target(build_, ref);
  const auto is_set = [&](std::string_view name) {
    const Site flag = word(name);
    return flag.exists() && build_.document(flag).kind(flag.node) == json::Kind::true_value;
  };
  shape.may_point = is_set("mayPoint");
  shape.essential = is_set("essential");
  if (const Site why = word("byPosition"); why.exists()) shape.by_position = build_.text(why);
  if (const Site slot = word("slot"); slot.exists()) shape.slot = read_slot(build_, slot);
  const Site names = word("enumNames");
  if (!names.exists()) return;
  for (const auto& member : build_.document(names).members(names.node)) {
    const std::string key(build_.document(names).key(member.key_id));
    // Ranges have names for their values too; they are kept as literals only if there is an enum.
    for (Literal& literal : shape.literals) {
      if (literal.kind == Literal::Kind::number &&
          literal.number == std::strtod(key.c_str(), nullptr)) {
        literal.name = build_.document(names).string(member.value);
      }
    }
  }
}

std::uint32_t ShapeBuilder::pattern(std::string_view expression) {
  auto& patterns = build_.set.patterns;
  const auto [known, is_new] =
      patterns_.emplace(expression, static_cast<std::uint32_t>(patterns.size()));
  if (!is_new) return known->second;
  auto compiled = Pattern::compile(expression);
  if (!compiled) return known->second = kNone;
  patterns.push_back(*std::move(compiled));
  return known->second;
}

}  // namespace gltfx::schema
