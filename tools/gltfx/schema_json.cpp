// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "json/writer.hpp"
#include "schema_print.hpp"
#include "schema_words.hpp"

namespace gltfx::tool {
namespace {

using json::Writer;
using schema::Set;
using schema::Shape;

void member_if(Writer& writer, std::string_view name, std::string_view value) {
  if (!value.empty()) writer.member(name, value);
}

template <class Texts>
void members_of(Writer& writer, std::string_view name, const Texts& texts) {
  writer.key(name);
  writer.begin_array();
  for (const auto& text : texts) writer.string(text);
  writer.end_array();
}

template <class Texts>
void members_if(Writer& writer, std::string_view name, const Texts& texts) {
  if (!texts.empty()) members_of(writer, name, texts);
}

void write_limit(Writer& writer, std::string_view inclusive, std::string_view exclusive,
                 double limit, bool is_exclusive) {
  if (!std::isfinite(limit)) return;
  writer.key(is_exclusive ? exclusive : inclusive);
  writer.number(limit);
}

void write_count(Writer& writer, std::string_view name, std::uint64_t count, std::uint64_t open) {
  if (count != open) writer.member(name, count);
}

void write_literal(Writer& writer, const schema::Literal& literal) {
  switch (literal.kind) {
    case schema::Literal::Kind::null:
      return writer.null();
    case schema::Literal::Kind::boolean:
      return writer.boolean(literal.number != 0);
    case schema::Literal::Kind::number:
      return writer.number(literal.number);
    case schema::Literal::Kind::string:
      break;
  }
  writer.string(literal.string);
}

// Limits of one value, with the names of JSON Schema.
void write_limits(Writer& writer, const Set& set, const Shape& shape) {
  write_limit(writer, "minimum", "exclusiveMinimum", shape.minimum, shape.exclusive_minimum);
  write_limit(writer, "maximum", "exclusiveMaximum", shape.maximum, shape.exclusive_maximum);
  if (shape.multiple_of > 0) {
    writer.key("multipleOf");
    writer.number(shape.multiple_of);
  }
  write_count(writer, "minLength", shape.min_length, 0);
  write_count(writer, "maxLength", shape.max_length, UINT64_MAX);
  write_count(writer, "minItems", shape.min_items, 0);
  write_count(writer, "maxItems", shape.max_items, UINT64_MAX);
  if (shape.pattern != schema::kNone) writer.member("pattern", set.pattern_text(shape.pattern));
  member_if(writer, "format", shape.format);
  if (!shape.literals.empty()) {
    writer.key("enum");
    writer.begin_array();
    for (const schema::Literal& literal : shape.literals) write_literal(writer, literal);
    writer.end_array();
  }
  if (shape.ref) writer.member("ref", shape.ref->text);
  if (!shape.ref_has.empty()) {
    writer.member("refHas", fmt::format("{}", fmt::join(shape.ref_has, "/")));
  }
  if (shape.ref_name) writer.member("refName", shape.ref_name->text);
  if (shape.unit_length != schema::UnitLength::free) {
    writer.member("unitLength",
                  shape.unit_length == schema::UnitLength::error ? "error" : "warning");
  }
  if (shape.should_match != schema::kNone) {
    writer.member("shouldMatch", set.pattern_text(shape.should_match));
  }
}

void write_slot(Writer& writer, const schema::Slot& slot) {
  writer.key("slot");
  writer.begin_object();
  writer.member("channels", slot.channels);
  writer.member("colorSpace", slot.srgb ? "srgb" : "linear");
  member_if(writer, "scaledBy", slot.scaled_by);
  if (!slot.factors.empty()) {
    writer.key("factors");
    writer.begin_object();
    for (const auto& [channels, factor] : slot.factors) writer.member(channels, factor);
    writer.end_object();
  }
  writer.end_object();
}

void write_property(Writer& writer, const Set& set, const schema::Property& property) {
  writer.begin_object();
  writer.member("name", property.name);
  writer.member("type", type_words(set, property.shape));
  member_if(writer, "limits", limit_words(set, property.shape));
  writer.member("required", property.required);
  if (!property.default_json.empty()) {
    writer.key("default");
    writer.raw(property.default_json);
  }
  if (property.shape != schema::kNone) {
    const Shape& shape = set.shape(property.shape);
    write_limits(writer, set, shape);
    if (shape.items != schema::kNone) {
      writer.key("items");
      writer.begin_object();
      writer.member("type", type_words(set, shape.items));
      write_limits(writer, set, set.shape(shape.items));
      writer.end_object();
    }
    if (shape.slot) write_slot(writer, *shape.slot);
  }
  member_if(writer, "parameter", property.parameter);
  member_if(writer, "mutable", property.mutable_type);
  if (std::isfinite(property.animated_minimum)) {
    writer.key("animatedMinimum");
    writer.number(property.animated_minimum);
  }
  member_if(writer, "unit", property.unit);
  members_if(writer, "aliases", property.aliases);
  member_if(writer, "deprecated", property.deprecated);
  member_if(writer, "description", property.description);
  writer.end_object();
}

void write_type(Writer& writer, const Set& set, schema::TypeId id) {
  const schema::ObjectType& type = set.type(id);
  writer.begin_object();
  writer.member("type", type.name);
  member_if(writer, "description", set.shape(type.shape).description);
  writer.member("open", type.open);
  writer.key("properties");
  writer.begin_array();
  for (const schema::Property& property : type.properties) write_property(writer, set, property);
  writer.end_array();
  writer.end_object();
}

void write_relations(Writer& writer, std::string_view name,
                     const std::vector<schema::Relation>& relations, bool with_severity) {
  writer.key(name);
  writer.begin_array();
  for (const schema::Relation& relation : relations) {
    writer.begin_object();
    writer.member("extension", relation.extension);
    writer.member("because", relation.because);
    if (with_severity) writer.member("severity", relation.error ? "error" : "warning");
    writer.end_object();
  }
  writer.end_array();
}

void write_attributes(Writer& writer, std::string_view name,
                      const std::vector<schema::AttributeFormat>& attributes) {
  if (attributes.empty()) return;
  writer.key(name);
  writer.begin_array();
  for (const schema::AttributeFormat& attribute : attributes) {
    writer.begin_object();
    writer.member("semantic", attribute.semantic);
    members_of(writer, "types", attribute.types);
    members_of(writer, "components", attribute.components);
    writer.member("required", attribute.required);
    writer.end_object();
  }
  writer.end_array();
}

void write_generations(Writer& writer, const std::vector<schema::Generation>& generations) {
  if (generations.empty()) return;
  writer.key("generations");
  writer.begin_array();
  for (const schema::Generation& generation : generations) {
    writer.begin_object();
    writer.member("name", generation.name);
    writer.member("description", generation.description);
    members_if(writer, "with", generation.with);
    members_if(writer, "without", generation.without);
    writer.end_object();
  }
  writer.end_array();
}

void write_summary(Writer& writer, const Set& set, const schema::Extension& extension) {
  writer.member("extension", extension.name);
  writer.member("status", schema::status_name(extension.status));
  member_if(writer, "revision", extension.revision);
  members_of(writer, "on", home_names(set, extension));
  member_if(writer, "successor", extension.successor);
  member_if(writer, "spec", extension.spec);
}

void write_extension(Writer& writer, const Set& set, schema::ExtensionId id) {
  const schema::Extension& extension = set.extensions()[id];
  writer.begin_object();
  write_summary(writer, set, extension);
  member_if(writer, "description", extension.description);
  member_if(writer, "mustBeRequired", must_be_required_name(extension.must_be_required));
  member_if(writer, "fallback", extension.fallback);
  write_relations(writer, "excludes", extension.excludes, false);
  write_relations(writer, "requires", extension.requires_, true);
  write_relations(writer, "overriddenBy", extension.overridden_by, false);
  writer.member("standalone", extension.standalone);
  writer.member("undrawn", extension.undrawn);
  members_if(writer, "imageMimeTypes", extension.image_mime_types);
  write_attributes(writer, "vertexAttributes", extension.vertex_attributes);
  write_attributes(writer, "morphAttributes", extension.morph_attributes);
  write_attributes(writer, "instanceAttributes", extension.instance_attributes);
  write_generations(writer, extension.generations);
  member_if(writer, "upgradesTo", extension.upgrade.to);
  members_if(writer, "upgradesToOther", extension.upgrade.alternatives);
  member_if(writer, "upgradeOnRequest", extension.upgrade.opt_in);
  writer.key("objects");
  writer.begin_array();
  for (const schema::TypeId type : types_of(set, id)) write_type(writer, set, type);
  writer.end_array();
  writer.end_object();
}

}  // namespace

std::string type_json(const Set& set, schema::TypeId id) {
  std::string text;
  Writer writer(text, true);
  write_type(writer, set, id);
  return text + '\n';
}

std::string extension_json(const Set& set, schema::ExtensionId id) {
  std::string text;
  Writer writer(text, true);
  write_extension(writer, set, id);
  return text + '\n';
}

std::string schema_list_json(const Set& set, const std::vector<schema::Status>& statuses) {
  std::string text;
  Writer writer(text, true);
  writer.begin_object();
  writer.key("extensions");
  writer.begin_array();
  for (const schema::Extension* extension : sorted_extensions(set, statuses)) {
    writer.begin_object();
    write_summary(writer, set, *extension);
    writer.end_object();
  }
  writer.end_array();
  if (statuses.empty()) members_of(writer, "coreTypes", core_type_names(set));
  writer.end_object();
  return text + '\n';
}

}  // namespace gltfx::tool
