// SPDX-License-Identifier: Apache-2.0
#include "schema/json_schema_keywords.hpp"

#include <algorithm>
#include <array>
#include <vector>

#include <fmt/format.h>

#include "base/suggestion.hpp"
#include "base/text.hpp"

namespace gltfx::schema {
namespace {

using Kind = Assertion::Kind;
using S = Shape2020;

constexpr std::array kKeywords{
    Keyword2020{"$schema", S::annotation},
    Keyword2020{"$id", S::annotation},
    Keyword2020{"$comment", S::annotation},
    Keyword2020{"title", S::annotation},
    Keyword2020{"description", S::annotation},
    Keyword2020{"default", S::annotation},
    Keyword2020{"examples", S::annotation},
    Keyword2020{"deprecated", S::annotation},
    Keyword2020{"readOnly", S::annotation},
    Keyword2020{"writeOnly", S::annotation},
    Keyword2020{"$defs", S::consumed},
    Keyword2020{"$ref", S::reference, Kind::reference},
    Keyword2020{"type", S::type, Kind::type},
    Keyword2020{"enum", S::literals, Kind::equals},
    Keyword2020{"const", S::literal, Kind::equals},
    Keyword2020{"minimum", S::number, Kind::minimum},
    Keyword2020{"maximum", S::number, Kind::maximum},
    Keyword2020{"exclusiveMinimum", S::number, Kind::exclusive_minimum},
    Keyword2020{"exclusiveMaximum", S::number, Kind::exclusive_maximum},
    Keyword2020{"multipleOf", S::number, Kind::multiple_of},
    Keyword2020{"minLength", S::count, Kind::min_length},
    Keyword2020{"maxLength", S::count, Kind::max_length},
    Keyword2020{"pattern", S::pattern, Kind::pattern},
    Keyword2020{"minItems", S::count, Kind::min_items},
    Keyword2020{"maxItems", S::count, Kind::max_items},
    Keyword2020{"uniqueItems", S::flag, Kind::unique_items},
    Keyword2020{"prefixItems", S::schemas, Kind::prefix_items},
    Keyword2020{"items", S::schema, Kind::items},
    Keyword2020{"contains", S::schema, Kind::contains},
    Keyword2020{"minContains", S::consumed},
    Keyword2020{"maxContains", S::consumed},
    Keyword2020{"minProperties", S::count, Kind::min_properties},
    Keyword2020{"maxProperties", S::count, Kind::max_properties},
    Keyword2020{"required", S::names, Kind::required},
    Keyword2020{"properties", S::schema_map, Kind::properties},
    Keyword2020{"patternProperties", S::pattern_map, Kind::pattern_properties},
    Keyword2020{"additionalProperties", S::schema, Kind::additional_properties},
    Keyword2020{"propertyNames", S::schema, Kind::property_names},
    Keyword2020{"dependentRequired", S::names_map, Kind::dependent_required},
    Keyword2020{"dependentSchemas", S::schema_map, Kind::dependent_schemas},
    Keyword2020{"allOf", S::schemas, Kind::all_of},
    Keyword2020{"anyOf", S::schemas, Kind::any_of},
    Keyword2020{"oneOf", S::schemas, Kind::one_of},
    Keyword2020{"not", S::schema, Kind::not_},
    Keyword2020{"if", S::schema, Kind::condition},
    Keyword2020{"then", S::consumed},
    Keyword2020{"else", S::consumed},
};

struct Unsupported {
  std::string_view name;
  std::string_view instead;  ///< what to write
};

// Keywords that JSON Schema has, or had before 2020-12, and a rule has not.
constexpr std::array kUnsupported{
    Unsupported{"format", "; write a 'pattern'"},
    Unsupported{"unevaluatedProperties", "; write 'additionalProperties'"},
    Unsupported{"unevaluatedItems", "; write 'items', which applies behind 'prefixItems'"},
    Unsupported{"additionalItems", "; write 'items', which applies behind 'prefixItems'"},
    Unsupported{"definitions", "; write '$defs'"},
    Unsupported{"dependencies", "; write 'dependentRequired' or 'dependentSchemas'"},
    Unsupported{"$anchor", "; write a '$ref' to '#/$defs/NAME'"},
    Unsupported{"$dynamicAnchor", "; write a '$ref' to '#/$defs/NAME'"},
    Unsupported{"$recursiveAnchor", "; write a '$ref' to '#/$defs/NAME'"},
    Unsupported{"$dynamicRef", "; write '$ref'"},
    Unsupported{"$recursiveRef", "; write '$ref'"},
    Unsupported{"$vocabulary", ""},
    Unsupported{"contentEncoding", ""},
    Unsupported{"contentMediaType", ""},
    Unsupported{"contentSchema", ""},
};

}  // namespace

const Keyword2020* find_keyword(std::string_view name) {
  const auto found = std::find_if(kKeywords.begin(), kKeywords.end(),
                                  [&](const Keyword2020& one) { return one.name == name; });
  return found == kKeywords.end() ? nullptr : &*found;
}

std::string unknown_keyword(std::string_view name) {
  const auto known = std::find_if(kUnsupported.begin(), kUnsupported.end(),
                                  [&](const Unsupported& keyword) { return keyword.name == name; });
  if (known != kUnsupported.end()) {
    return fmt::format("{} is a keyword that rules do not have{}", quoted(name), known->instead);
  }
  std::vector<std::string_view> names;
  for (const Keyword2020& one : kKeywords) names.push_back(one.name);
  return fmt::format("{} is no keyword of JSON Schema{}", quoted(name), did_you_mean(name, names));
}

}  // namespace gltfx::schema
