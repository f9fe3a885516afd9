// SPDX-License-Identifier: Apache-2.0
#include "rules/targets/features.hpp"

#include <algorithm>
#include <string>

namespace gltfx::validate {
namespace {

// The string of that name in a list of the root object.
json::NodeId declaration(const json::Document& document, std::string_view list,
                         std::string_view name) {
  const json::NodeId array = document.find(document.root(), list);
  if (array == json::kNoNode || document.kind(array) != json::Kind::array) return json::kNoNode;
  for (const json::NodeId each : document.elements(array)) {
    if (document.is_string(each) && document.string(each) == name) return each;
  }
  return array;
}

bool has_fallback(const Context& context, const std::string& name) {
  const schema::ExtensionId id = context.schemas.find_extension(name);
  if (id == schema::kNone || context.schemas.extensions()[id].fallback.empty()) return false;
  const auto& without = context.checked.without_fallback;
  return std::find(without.begin(), without.end(), name) == without.end();
}

void find_extensions(const Context& context, Features& features) {
  const json::Document& document = context.document;
  const auto& known = target_features();
  for (const std::string& name : context.checked.extensions_required) {
    const json::NodeId place = declaration(document, "extensionsRequired", name);
    if (known.count(name) == 0) {
      features.note("extension.unknown-required", place);
      continue;
    }
    const bool fallback = has_fallback(context, name);
    features.note(name, place, fallback ? FeatureUse::required_with_fallback : FeatureUse::required,
                  fallback);
  }
  for (const std::string& name : context.checked.extensions_used) {
    if (features.has(name)) continue;
    const json::NodeId place = declaration(document, "extensionsUsed", name);
    if (known.count(name) > 0) {
      features.note(name, place, FeatureUse::used, has_fallback(context, name));
    } else {
      features.note("extension.unknown-used", place);
    }
  }
}

}  // namespace

bool Features::matters(std::string_view name) const {
  return std::any_of(targets_.begin(), targets_.end(), [&](const TargetChoice& choice) {
    const auto found = choice.target->features.find(name);
    if (found == choice.target->features.end()) return false;
    const TargetRange* range = outcome_of(found->second.used, choice.version);
    return range != nullptr && range->outcome <= TargetOutcome::ignored;
  });
}

Features find_features(const Context& context, const model::ResourceData& resources) {
  Features features(context.options.targets);
  find_extensions(context, features);
  find_geometry_features(context, features);
  find_material_features(context, features);
  find_scene_features(context, features);
  find_metadata_features(context, features);
  find_file_features(context, resources, features);
  return features;
}

}  // namespace gltfx::validate
