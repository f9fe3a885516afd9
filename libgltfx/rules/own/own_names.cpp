// SPDX-License-Identifier: Apache-2.0
#include "rules/own/own_names.hpp"

#include <algorithm>
#include <set>
#include <string_view>

#include <fmt/format.h>

#include "base/suggestion.hpp"
#include "base/text.hpp"
#include "rules/own/own_measures.hpp"
#include "rules/own/own_members.hpp"
#include "schema/compile.hpp"

namespace gltfx::validate {
namespace {

using schema::Assertion;
using Schemas = std::set<std::uint32_t>;

bool names_members(const Assertion& assertion) {
  switch (assertion.kind) {
    case Assertion::Kind::properties:
    case Assertion::Kind::required:
    case Assertion::Kind::dependent_required:
    case Assertion::Kind::dependent_schemas:
      return true;
    default:
      return false;
  }
}

// Whether the schemas of a keyword are about the same object as the keyword.
bool is_in_place(const Assertion& assertion) {
  switch (assertion.kind) {
    case Assertion::Kind::dependent_schemas:
    case Assertion::Kind::reference:
    case Assertion::Kind::all_of:
    case Assertion::Kind::any_of:
    case Assertion::Kind::one_of:
    case Assertion::Kind::not_:
    case Assertion::Kind::condition:
      return true;
    default:
      return false;
  }
}

// Adds the schemas that are about the same object.
Schemas with_in_place(const schema::JsonSchema& schema, Schemas all) {
  std::vector<std::uint32_t> open(all.begin(), all.end());
  while (!open.empty()) {
    const std::uint32_t at = open.back();
    open.pop_back();
    for (const Assertion& assertion : schema.subschemas()[at].assertions) {
      if (!is_in_place(assertion)) continue;
      for (const std::uint32_t inner : assertion.schemas) {
        if (inner != schema::kNoSchema && all.insert(inner).second) open.push_back(inner);
      }
    }
  }
  return all;
}

std::vector<std::string_view> members_of_gltfx(const OwnScope& scope) {
  std::vector<std::string_view> names = own_members(scope);
  const auto on = measure_scope_of(scope);
  if (!on) return names;
  for (const MeasureDescription& measure : measures()) {
    if (find_measure(*on, measure.name) != nullptr) names.push_back(measure.name);
  }
  return names;
}

std::vector<std::string_view> members_of_object(const OwnScope& scope) {
  const schema::Set& set = *schema::builtin_set();
  const bool primitive = scope.place == OwnScope::Place::primitive;
  const schema::TypeId type = set.find_type(primitive ? "mesh.primitive" : scope.name);
  std::vector<std::string_view> names{kOwnMember, "extensions", "extras"};
  if (type == schema::kNone) return names;
  for (const schema::Property& property : set.type(type).properties) names.push_back(property.name);
  return names;
}

void add_unknown(const schema::JsonSchema& schema, const Schemas& schemas, std::string_view whose,
                 const std::vector<std::string_view>& known, std::vector<UnknownMember>& unknown) {
  for (const std::uint32_t at : schemas) {
    for (const Assertion& assertion : schema.subschemas()[at].assertions) {
      if (!names_members(assertion)) continue;
      for (const std::string& name : assertion.names) {
        if (std::find(known.begin(), known.end(), name) != known.end()) continue;
        unknown.push_back({name, fmt::format("{} has no member {}{}", whose, gltfx::quoted(name),
                                             did_you_mean(name, known))});
      }
    }
  }
}

}  // namespace

std::vector<UnknownMember> unknown_members(const schema::JsonSchema& schema,
                                           const OwnScope& scope) {
  std::vector<UnknownMember> unknown;
  const Schemas object = with_in_place(schema, {0});
  add_unknown(schema, object, fmt::format("the object {}", scope.name), members_of_object(scope),
              unknown);
  Schemas own;
  for (const std::uint32_t at : object) {
    for (const Assertion& assertion : schema.subschemas()[at].assertions) {
      if (assertion.kind != Assertion::Kind::properties) continue;
      for (std::size_t i = 0; i < assertion.names.size(); ++i) {
        if (assertion.names[i] == kOwnMember) own.insert(assertion.schemas[i]);
      }
    }
  }
  add_unknown(schema, with_in_place(schema, std::move(own)), kOwnMember, members_of_gltfx(scope),
              unknown);
  return unknown;
}

}  // namespace gltfx::validate
