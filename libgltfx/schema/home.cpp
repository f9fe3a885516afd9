// SPDX-License-Identifier: Apache-2.0
#include "schema/home.hpp"

#include <algorithm>
#include <vector>

#include "base/text.hpp"
#include "schema/walk_tables.hpp"

namespace gltfx::schema {
namespace {

using Way = Home::Way;

bool knows(const Set& set, TypeId type, std::string_view name, const Version& version) {
  const Property* property = type == kNone ? nullptr : set.find_property(type, name);
  return property != nullptr && property->draft.empty() && property->since <= version;
}

// An object among the elements of an array, if it is the only one.
json::NodeId only_element(const json::Document& document, json::NodeId array) {
  const bool one = array != json::kNoNode && document.kind(array) == json::Kind::array &&
                   document.array_size(array) == 1;
  return one ? array + 1 : json::kNoNode;
}

Home through_property(const Set& set, const json::Document& document, const Neighbourhood& around,
                      const Property& property, std::string_view name) {
  Home home;
  if (property.shape == kNone || around.version < property.since) return home;
  const Shape& shape = set.shape(property.shape);
  const ShapeId items = shape.items;
  const json::NodeId value = document.find(around.object, property.name);
  if (knows(set, shape.type, name, around.version)) {
    home = {Way::member, shape.type, property.name, value, true};
  } else if (items != kNone && knows(set, set.shape(items).type, name, around.version)) {
    home = {Way::element, set.shape(items).type, property.name, only_element(document, value)};
    home.is_certain = home.object != json::kNoNode;
  }
  const bool broken = home.object != json::kNoNode && !document.is_object(home.object);
  if (broken) home.is_certain = false;
  return home;
}

// The only home, or the only one that the document has.
Home choose(const std::vector<Home>& homes) {
  if (homes.size() == 1) return homes.front();
  const auto is_there = [](const Home& home) { return home.object != json::kNoNode; };
  if (std::count_if(homes.begin(), homes.end(), is_there) != 1) return {};
  return *std::find_if(homes.begin(), homes.end(), is_there);
}

std::vector<Home> in_core(const Set& set, const json::Document& document,
                          const Neighbourhood& around, std::string_view name) {
  std::vector<Home> homes;
  for (const Property& property : set.type(around.type).properties) {
    const Home home = through_property(set, document, around, property, name);
    if (home.way != Way::none) homes.push_back(home);
  }
  if (knows(set, around.type_above, name, around.version)) {
    homes.push_back({Way::above, around.type_above, {}, around.object_above, !around.among_others});
  }
  return homes;
}

std::vector<Home> in_extensions(const Set& set, const json::Document& document,
                                const Neighbourhood& around, std::string_view name) {
  std::vector<Home> homes;
  const json::NodeId holder = document.find(around.object, "extensions");
  for (const Extension& extension : set.extensions()) {
    const ShapeId shape = extension.shape_on(set.type(around.type).origin);
    if (shape == kNone || !knows(set, set.shape(shape).type, name, around.version)) continue;
    const json::NodeId object = document.find(holder, extension.name);
    const bool there = object != json::kNoNode && document.is_object(object);
    homes.push_back({Way::extension, set.shape(shape).type, extension.name,
                     there ? object : json::kNoNode, there});
  }
  return homes;
}

}  // namespace

Home find_home(const Set& set, const json::Document& document, const Neighbourhood& around,
               std::string_view name) {
  // Many types have `name`, so it does not identify a home.
  if (around.type == kNone || name == "name") return {};
  const std::vector<Home> homes = in_core(set, document, around, name);
  return choose(homes.empty() ? in_extensions(set, document, around, name) : homes);
}

std::string home_name(const Set& set, const Home& home) {
  if (home.way == Way::element) return "an element of " + quoted(home.through);
  if (home.way != Way::above) return quoted(home.through);
  return home.type == set.walk_tables().root ? "the root object" : quoted(set.type(home.type).name);
}

}  // namespace gltfx::schema
