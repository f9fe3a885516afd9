// SPDX-License-Identifier: Apache-2.0
// Reads the members that a schema describes into an ObjectType. Values inside x-gltfx have passed
// the vocabulary check: their forms are right.
#include <algorithm>
#include <unordered_map>
#include <unordered_set>

#include "base/suggestion.hpp"
#include "base/text.hpp"
#include "schema/shape_builder.hpp"

namespace gltfx::schema {
namespace {

// Every object may have these two in addition to its known members; a schema need not list them.
bool is_common_member(std::string_view name) { return name == "extensions" || name == "extras"; }

// Listed only because other validators need it: {} or { "type": "object" }.
bool says_nothing(const Shape& shape) {
  return (shape.types & ~kObject) == 0 && shape.type == kNone && shape.values == kNone &&
         !shape.never && shape.min_properties == 0 && shape.any_of.empty() &&
         shape.one_of.empty() && shape.all_of.empty() && shape.literals.empty();
}

}  // namespace

std::vector<std::string> split_steps(std::string_view text) {
  std::vector<std::string> steps;
  while (true) {
    const std::size_t end = std::min(text.find('/'), text.size());
    steps.emplace_back(text.substr(0, end));
    if (end == text.size()) return steps;
    text.remove_prefix(end + 1);
  }
}

void ShapeBuilder::finish_members(ShapeId id, Site schema, const Where& where, Shape& shape,
                                  const Members& members) {
  const json::Document& document = build_.document(schema);
  const bool closed = members.additional.exists() &&
                      document.kind(members.additional.node) == json::Kind::false_value;
  if (members.additional.exists() && !document.is_boolean(members.additional.node)) {
    shape.values = request(members.additional, where);
  }
  if (!members.properties.exists() && !members.required.exists() && !closed &&
      shape.dependent_required.empty()) {
    return;
  }
  ObjectType type;
  type.name = where.type_name;
  type.shape = id;
  type.properties = read_properties(members, where);
  type.open = members.additional.exists() ? !closed : where.branch || !members.properties.exists();
  type.strict = closed;
  type.extension = build_.extension_of[schema.source];
  if (!type.open) report_misspelt_required(members, type);
  shape.type = static_cast<TypeId>(build_.set.types.size());
  type.origin = shape.type;
  if (!where.branch) build_.set.type_ids.emplace(type.name, shape.type);
  build_.set.types.push_back(std::move(type));
}

std::vector<Property> ShapeBuilder::read_properties(const Members& members, const Where& where) {
  std::vector<Property> properties;
  if (members.properties.exists()) {
    const json::Document& document = build_.document(members.properties);
    for (const auto& member : document.members(members.properties.node)) {
      const Site schema{members.properties.source, member.value};
      properties.push_back(read_property(schema, document.key(member.key_id), where));
    }
  }
  std::unordered_map<std::string, std::size_t> places;
  for (std::size_t i = 0; i < properties.size(); ++i) places.emplace(properties[i].name, i);
  for (const std::string& name : read_names(build_, members.required)) {
    const auto [place, is_new] = places.emplace(name, properties.size());
    if (is_new) properties.emplace_back().name = name;
    properties[place->second].required = true;
  }
  return properties;
}

Property ShapeBuilder::read_property(Site schema, std::string_view name, const Where& where) {
  Property property;
  property.name = name;
  const std::string type_name = where.type_name + "." + property.name;
  property.shape =
      request(schema, {type_name, where.type_name + "/" + property.name, where.branch});
  if (!build_.document(schema).is_object(schema.node)) return property;
  const auto text = [&](Site at) { return at.exists() ? build_.text(at) : std::string(); };
  property.description = text(build_.member(schema, "description"));
  const Site fallback = build_.member(schema, "default");
  if (fallback.exists()) property.default_json = build_.document(fallback).raw(fallback.node);
  const Site deprecated = build_.member(schema, "deprecated");
  if (deprecated.exists() &&
      build_.document(deprecated).kind(deprecated.node) == json::Kind::true_value) {
    property.deprecated = "it is deprecated";
  }
  const Site annotation = build_.member(schema, "x-gltfx");
  if (!annotation.exists()) return property;
  property.parameter = text(build_.member(annotation, "parameter"));
  property.mutable_type = text(build_.member(annotation, "mutable"));
  const Site least = build_.member(annotation, "animatedMinimum");
  if (least.exists() && build_.document(least).is_number(least.node)) {
    property.animated_minimum = build_.document(least).number(least.node).value;
  }
  property.draft = text(build_.member(annotation, "draft"));
  read_versions(annotation, where, property);
  property.unit = text(build_.member(annotation, "unit"));
  property.aliases = read_names(build_, build_.member(annotation, "aliases"));
  const Site late = build_.member(annotation, "addedLate");
  property.added_late =
      late.exists() && build_.document(late).kind(late.node) == json::Kind::true_value;
  const std::string instead = text(build_.member(annotation, "deprecated"));
  if (!instead.empty()) property.deprecated = instead;
  return property;
}

// What depends on the version of the asset.
void ShapeBuilder::read_versions(Site annotation, const Where& where, Property& property) {
  const Site since = build_.member(annotation, "since");
  if (since.exists()) property.since = read_version(build_, since);
  property.without = read_names(build_, build_.member(annotation, "without"));
  const Site should = build_.member(annotation, "should");
  if (!should.exists()) return;
  const std::string label = where.type_name + "/" + property.name;
  Advice advice;
  advice.shape = request(build_.member(should, "value"), {where.type_name, label, true});
  advice.since = read_version(build_, build_.member(should, "since"));
  advice.because = build_.text(build_.member(should, "because"));
  property.should = std::move(advice);
}

// A required member that the object does not have can never be valid.
void ShapeBuilder::report_misspelt_required(const Members& members, const ObjectType& type) {
  if (!members.required.exists() || !members.properties.exists()) return;
  const json::Document& document = build_.document(members.required);
  std::vector<std::string_view> known;
  for (const auto& member : document.members(members.properties.node)) {
    known.push_back(document.key(member.key_id));
  }
  if (document.kind(members.required.node) != json::Kind::array) return;
  const std::unordered_set<std::string_view> names(known.begin(), known.end());
  for (const json::NodeId name : document.elements(members.required.node)) {
    const std::string text = document.string(name);
    if (is_common_member(text) || names.count(text) != 0 || build_.errors.is_full()) continue;
    build_.errors.add({members.required.source, name},
                      quoted(text) + " is required, but not a property of " + quoted(type.name) +
                          did_you_mean(text, known));
  }
}

void drop_common_members(SetParts& set) {
  for (ObjectType& type : set.types) {
    const auto plain = [&](const Property& p) {
      return is_common_member(p.name) && !p.required &&
             (p.shape == kNone || says_nothing(set.shapes[p.shape]));
    };
    type.properties.erase(std::remove_if(type.properties.begin(), type.properties.end(), plain),
                          type.properties.end());
  }
}

Slot read_slot(const Build& build, Site at) {
  Slot slot;
  slot.channels = build.text(build.member(at, "channels"));
  slot.srgb = build.text(build.member(at, "colorSpace")) == "srgb";
  const Site scaled_by = build.member(at, "scaledBy");
  if (scaled_by.exists()) slot.scaled_by = build.text(scaled_by);
  const Site factors = build.member(at, "factors");
  if (!factors.exists()) return slot;
  const json::Document& document = build.document(factors);
  for (const auto& member : document.members(factors.node)) {
    slot.factors.emplace_back(document.key(member.key_id), document.string(member.value));
  }
  return slot;
}

// "accessors", "/extensions/KHR_x/things" or "animation/samplers"; the type's id is found later.
Target read_target(const Build& build, Site at) {
  Target target;
  target.text = build.text(at);
  const std::string_view text = target.text;
  if (text.substr(0, 1) == "/") {
    target.base = Target::Base::root_path;
    target.steps = split_steps(text.substr(1));
    return target;
  }
  target.steps = split_steps(text);
  if (target.steps.size() > 1) {
    target.base = Target::Base::enclosing;
    target.steps.erase(target.steps.begin());
  }
  return target;
}

Version read_version(const Build& build, Site at) {
  return at.exists() ? parse_version(build.text(at)).value_or(kVersion2) : kVersion2;
}

std::vector<std::string> read_names(const Build& build, Site list) {
  std::vector<std::string> names;
  if (!list.exists()) return names;
  const json::Document& document = build.document(list);
  if (document.is_string(list.node)) return {document.string(list.node)};
  if (document.kind(list.node) != json::Kind::array) return names;
  for (const json::NodeId name : document.elements(list.node))
    names.push_back(document.string(name));
  return names;
}

Literal read_literal(const json::Document& document, json::NodeId node) {
  Literal literal;
  switch (document.kind(node)) {
    case json::Kind::string:
      literal.kind = Literal::Kind::string;
      literal.string = document.string(node);
      break;
    case json::Kind::number:
      literal.kind = Literal::Kind::number;
      literal.number = document.number(node).value;
      break;
    case json::Kind::true_value:
    case json::Kind::false_value:
      literal.kind = Literal::Kind::boolean;
      literal.number = document.kind(node) == json::Kind::true_value ? 1 : 0;
      break;
    default:
      break;
  }
  return literal;
}

std::vector<Literal> read_literals(const Build& build, Site list) {
  const json::Document& document = build.document(list);
  std::vector<Literal> all;
  if (document.kind(list.node) == json::Kind::number_array) {
    for (json::NumberCursor at(document, list.node); at.valid(); at.advance()) {
      all.emplace_back().kind = Literal::Kind::number;
      all.back().number = at.number().value;
    }
    return all;
  }
  for (const json::NodeId item : document.elements(list.node))
    all.push_back(read_literal(document, item));
  return all;
}

}  // namespace gltfx::schema
