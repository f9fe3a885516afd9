// SPDX-License-Identifier: Apache-2.0
#include "schema/set.hpp"

#include <algorithm>

#include "schema/build.hpp"
#include "schema/vocabulary.hpp"
#include "schema/walk_tables.hpp"

namespace gltfx::schema {
namespace {

const Property* find_in(const ObjectType& type, std::string_view name) {
  const auto found = std::find_if(type.properties.begin(), type.properties.end(),
                                  [name](const Property& p) { return p.name == name; });
  return found == type.properties.end() ? nullptr : &*found;
}

template <class Map>
std::uint32_t find_id(const Map& map, const std::string& name) {
  const auto found = map.find(name);
  return found == map.end() ? kNone : found->second;
}

}  // namespace

std::string_view status_name(Status status) {
  return listed_values(Form::status)[static_cast<std::size_t>(status)];
}

ShapeId Extension::shape_on(TypeId type) const {
  const auto found = std::find_if(attachment_points.begin(), attachment_points.end(),
                                  [type](const auto& home) { return home.first == type; });
  return found == attachment_points.end() ? kNone : found->second;
}

TypeId Set::find_type(std::string_view name) const { return find_id(type_ids_, std::string(name)); }

ExtensionId Set::find_extension(std::string_view name) const {
  return find_id(extension_ids_, std::string(name));
}

const Property* Set::find_property(TypeId type, std::string_view name) const {
  return type == kNone ? nullptr : find_in((*types_)[type], name);
}

bool Set::matches(std::uint32_t pattern, std::string_view text) const {
  return (*patterns_)[pattern].matches(text);
}

std::string_view Set::pattern_text(std::uint32_t pattern) const {
  return (*patterns_)[pattern].text();
}

TypeId SetParts::find_type(const std::string& name) const { return find_id(type_ids, name); }

ExtensionId SetParts::find_extension(const std::string& name) const {
  return find_id(extension_ids, name);
}

const Property* SetParts::find_property(TypeId type, std::string_view name) const {
  return type == kNone ? nullptr : find_in(types[type], name);
}

std::shared_ptr<const Set> SetWriter::close(SetParts parts, const Hash128& sources) {
  LazyParts lazy{std::make_shared<const Lazy<Shape>>(std::move(parts.shapes)),
                 std::make_shared<const Lazy<ObjectType>>(std::move(parts.types))};
  const std::shared_ptr<Set> set = make(std::move(parts), std::move(lazy));
  set->sources_ = sources;
  set->walk_tables_ = make_walk_tables(*set);
  return set;
}

std::shared_ptr<const Set> SetWriter::close(SetParts parts, LazyParts lazy, WalkPlans plans) {
  const std::shared_ptr<Set> set = make(std::move(parts), std::move(lazy));
  set->walk_tables_ = make_walk_tables(*set, std::move(plans));
  return set;
}

std::shared_ptr<Set> SetWriter::make(SetParts parts, LazyParts lazy) {
  auto set = std::make_shared<Set>();
  set->shapes_ = std::move(lazy.shapes);
  set->types_ = std::move(lazy.types);
  set->extensions_ = std::move(parts.extensions);
  set->versions_ = std::move(parts.versions);
  set->type_ids_ = std::move(parts.type_ids);
  set->extension_ids_ = std::move(parts.extension_ids);
  set->patterns_ = std::make_shared<const std::vector<Pattern>>(std::move(parts.patterns));
  return set;
}

SetParts SetWriter::open(const Set& set) {
  SetParts parts{
      {}, {}, set.extensions_, set.versions_, set.type_ids_, set.extension_ids_, *set.patterns_};
  for (ShapeId id = 0; id < set.shapes().size(); ++id) parts.shapes.push_back(set.shape(id));
  for (TypeId id = 0; id < set.types().size(); ++id) parts.types.push_back(set.type(id));
  return parts;
}

}  // namespace gltfx::schema
