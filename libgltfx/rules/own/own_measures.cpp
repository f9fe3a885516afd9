// SPDX-License-Identifier: Apache-2.0
#include "rules/own/own_measures.hpp"

#include <set>
#include <vector>

#include "measure/take.hpp"
#include "rules/collector.hpp"
#include "rules/own/own_rules.hpp"

namespace gltfx::validate {
namespace {

void add_named(const OwnPage& page, std::vector<measure::Wanted>& wanted) {
  for (const MeasureDescription* one : named_measures(page)) {
    wanted.push_back(
        {*measure_scope_of(*page.scope), static_cast<measure::Name>(one - measures().data())});
  }
}

}  // namespace

std::optional<MeasureScope> measure_scope_of(const OwnScope& scope) {
  if (scope.place == OwnScope::Place::root) return MeasureScope::asset;
  return measure_scope_from_name(scope.name);
}

// Members that the schema names at any depth: more than those of `gltfx`, which costs little.
std::vector<const MeasureDescription*> named_measures(const OwnPage& page) {
  std::set<const MeasureDescription*> named;
  const auto scope = measure_scope_of(*page.scope);
  if (!scope) return {};
  for (const schema::Subschema& subschema : page.schema.subschemas()) {
    for (const schema::Assertion& assertion : subschema.assertions) {
      for (const std::string& name : assertion.names) {
        if (const auto* known = find_measure(*scope, name)) named.insert(known);
      }
    }
  }
  return {named.begin(), named.end()};
}

std::optional<Measurements> take_own_measures(const Context& context,
                                              const measure::Source& source) {
  const bool runs = context.options.own_rules && !context.deviations.no_additional_rules;
  if (!runs) return std::nullopt;
  measure::Request request;
  request.wanted.emplace();
  const auto& pages = context.options.own_rules->pages();
  for (std::size_t i = 0; i < pages.size(); ++i) {
    if (is_enabled(context.options, own_code(i))) add_named(*pages[i], *request.wanted);
  }
  if (request.wanted->empty()) return std::nullopt;
  if (context.options.products)
    request.parameters.product = context.options.products->find(source.name());
  request.pixels = context.options.pixels != PixelLevel::headers;
  return measure::take(source, request);
}

}  // namespace gltfx::validate
