// SPDX-License-Identifier: Apache-2.0
// Keywords about arrays and objects.
#include <algorithm>

#include <fmt/format.h>

#include "base/text.hpp"
#include "schema/json_schema_evaluation.hpp"

namespace gltfx::schema {
namespace {

using Kind = Assertion::Kind;

}  // namespace

// The one more member only of the checked object.
std::optional<JsonValue> Evaluation::member(const JsonValue& value, std::string_view name) const {
  if (is_checked_object(value) && object_.more && name == object_.more_name) {
    const json::Document& more = object_.more();
    return JsonValue{&more, more.root()};
  }
  const json::NodeId node = value.document->find(value.node, name);
  if (node == json::kNoNode) return std::nullopt;
  return JsonValue{value.document, node};
}

bool Evaluation::array_holds(const Assertion& assertion, const Frame& at) {
  switch (assertion.kind) {
    case Kind::min_items:
    case Kind::max_items:
      return size_holds(assertion, at, at.value.document->array_size(at.value.node), "element");
    case Kind::unique_items: {
      if (!spend(1 + at.value.raw().size())) return true;
      const auto twice = equal_elements(at.value, work_, exhausted_);
      return !twice || fail(at, [&] {
        return fmt::format("elements {} and {} are equal", twice->first, twice->second);
      });
    }
    case Kind::contains:
      return contains_enough(assertion, at);
    default:
      return items_hold(assertion, at);
  }
}

bool Evaluation::items_hold(const Assertion& assertion, const Frame& at) {
  const bool prefix = assertion.kind == Kind::prefix_items;
  return at.value.all_elements([&](std::uint64_t index, const JsonValue& element) {
    if (prefix && index >= assertion.schemas.size()) return true;
    if (!prefix && index < assertion.least) return spend(1);
    return fits(assertion.schemas[prefix ? index : 0], element, Path(at.path, index), at.failure);
  });
}

bool Evaluation::contains_enough(const Assertion& assertion, const Frame& at) {
  std::uint64_t found = 0;
  at.value.all_elements([&](std::uint64_t, const JsonValue& element) {
    if (fits(assertion.schemas[0], element, at.path, nullptr)) ++found;
    return !exhausted_ && found <= assertion.most;
  });
  if (exhausted_ || (found >= assertion.least && found <= assertion.most)) return true;
  if (found > assertion.most) {
    return fail(at, [&] {
      return fmt::format("more than {} of its elements fit the schema in 'contains'",
                         assertion.most);
    });
  }
  return fail(at, [&] {
    return fmt::format("{} of its elements fit the schema in 'contains'; there must be at least {}",
                       found, assertion.least);
  });
}

bool Evaluation::all_there(const std::vector<std::string>& names, const Frame& at,
                           std::string_view because) {
  for (const std::string& name : names) {
    if (!spend(1)) return true;
    if (member(at.value, name)) continue;
    return because.empty()
               ? fail(at, [&] { return fmt::format("{} is missing", quoted(name)); })
               : fail(at, [&] {
                   return fmt::format("{} is missing beside {}", quoted(name), quoted(because));
                 });
  }
  return true;
}

bool Evaluation::object_holds(const Assertion& assertion, const Frame& at) {
  switch (assertion.kind) {
    case Kind::min_properties:
    case Kind::max_properties:
      return size_holds(assertion, at, at.value.document->object_size(at.value.node), "member");
    case Kind::required:
      return all_there(assertion.names, at, {});
    case Kind::dependent_required:
      for (std::size_t i = 0; i < assertion.names.size(); ++i) {
        if (!member(at.value, assertion.names[i])) continue;
        if (!all_there(assertion.lists[i], at, assertion.names[i])) return false;
      }
      return true;
    case Kind::properties:
    case Kind::dependent_schemas:
      return properties_hold(assertion, at);
    default:
      return members_hold(assertion, at);
  }
}

bool Evaluation::properties_hold(const Assertion& assertion, const Frame& at) {
  for (std::size_t i = 0; i < assertion.names.size(); ++i) {
    if (!spend(1)) return true;
    const auto value = member(at.value, assertion.names[i]);
    if (!value) continue;
    const bool inside = assertion.kind == Kind::properties;
    const Path path(at.path, std::string_view(assertion.names[i]));
    if (!fits(assertion.schemas[i], inside ? *value : at.value, inside ? path : at.path,
              at.failure)) {
      return false;
    }
  }
  return true;
}

bool Evaluation::members_hold(const Assertion& assertion, const Frame& at) {
  const json::Document& document = *at.value.document;
  for (const auto& found : document.members(at.value.node)) {
    const std::string_view name = document.key(found.key_id);
    const Path path(at.path, name);
    const JsonValue value{&document, found.value};
    if (!spend(1)) return true;
    if (assertion.kind == Kind::property_names) {
      const JsonValue key{&document, found.key};
      SchemaFailure inner;
      if (fits(assertion.schemas[0], key, path, at.failure == nullptr ? nullptr : &inner)) continue;
      return fail({key, path, at.failure},
                  [&] { return fmt::format("the name is not allowed: {}", inner.reason); });
    }
    if (assertion.kind == Kind::additional_properties) {
      const bool named =
          std::binary_search(assertion.names.begin(), assertion.names.end(), name) ||
          std::any_of(assertion.patterns.begin(), assertion.patterns.end(),
                      [&](const Pattern& pattern) { return matches(pattern, name); });
      if (named) continue;
      if (schema_.subschemas()[assertion.schemas[0]].never) {
        return fail(at, [&] { return fmt::format("{} is not allowed", quoted(name)); });
      }
      if (!fits(assertion.schemas[0], value, path, at.failure)) return false;
      continue;
    }
    for (std::size_t i = 0; i < assertion.patterns.size(); ++i) {
      if (!matches(assertion.patterns[i], name)) continue;
      if (!fits(assertion.schemas[i], value, path, at.failure)) return false;
    }
  }
  return true;
}

}  // namespace gltfx::schema
