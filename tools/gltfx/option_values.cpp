// SPDX-License-Identifier: Apache-2.0
#include "option_values.hpp"

#include <gltfx/measure.hpp>
#include <gltfx/report.hpp>
#include <gltfx/targets.hpp>
#include <gltfx/validate.hpp>

#include <algorithm>
#include <utility>

#include "presets.hpp"
#include "schema/compile.hpp"
#include "schema_words.hpp"
#include "steps/upgrade/choice.hpp"

namespace gltfx::tool {
namespace {

template <class Texts>
WordSet set_of(const Texts& texts, std::string name = {}) {
  return {std::move(name), std::vector<std::string>(texts.begin(), texts.end())};
}

WordSet codes() {
  WordSet set{"codes", {}};
  for (const RuleDescription& rule : rules()) set.words.emplace_back(rule.code);
  return set;
}

WordSet schema_names() {
  const schema::Set& set = *schema::builtin_set();
  WordSet names = set_of(core_type_names(set), "schema_names");
  for (const auto* extension : sorted_extensions(set, {})) names.words.push_back(extension->name);
  return names;
}

WordSet targets() {
  WordSet set{"targets", {}};
  for (const auto& target : builtin_targets()) set.words.push_back(target->name);
  return set;
}

// "triangles" of the asset, "mesh.triangles" of each mesh.
WordSet measure_names() {
  WordSet set{"measures", {}};
  for (const MeasureDescription& measure : measures()) {
    if (measure.is_of_asset()) set.words.emplace_back(measure.name);
    for (std::size_t i = 1; i < kMeasureScopeCount; ++i) {
      const auto scope = static_cast<MeasureScope>(i);
      if (!measure.is_on(scope)) continue;
      set.words.push_back(std::string(measure_scope_name(scope)) + '.' + std::string(measure.name));
    }
  }
  std::sort(set.words.begin(), set.words.end());
  return set;
}

WordSet presets() {
  WordSet set{"presets", {}};
  for (const EmbeddedPreset& preset : embedded_presets()) set.words.emplace_back(preset.id);
  return set;
}

Values sorted_choice(std::vector<std::string> names) {
  std::sort(names.begin(), names.end());
  names.erase(std::unique(names.begin(), names.end()), names.end());
  return values::choice(std::move(names));
}

}  // namespace

namespace values {

Values code_choice() { return {.words = codes()}; }

Values code_list() { return {.words = codes(), .commas = true}; }

Values code_levels() {
  WordSet levels;
  for (const Severity level :
       {Severity::error, Severity::warning, Severity::info, Severity::hint}) {
    levels.words.emplace_back(severity_name(level));
  }
  return {.words = codes(), .behind = std::move(levels)};
}

Values report_format_choice() {
  return {.words = set_of(report_format_names()), .file_behind = true};
}

Values schema_choice() { return {.words = schema_names()}; }

Values target_choice() { return {.words = targets()}; }

Values measure_choice() { return {.words = measure_names()}; }

Values measure_name() {
  std::vector<std::string> names;
  for (const MeasureDescription& measure : measures()) names.emplace_back(measure.name);
  return sorted_choice(std::move(names));
}

Values preset_choice() { return {.words = presets()}; }

Values target_list() { return {.words = targets(), .commas = true}; }

Values legacy_choice() { return sorted_choice(upgrade::legacy_names(*schema::builtin_set())); }

Values successor_choice() {
  return sorted_choice(upgrade::successor_names(*schema::builtin_set()));
}

Values generation_choice() { return sorted_choice(generation_names(*schema::builtin_set())); }

Values choice(std::vector<std::string> words) { return {.words = {{}, std::move(words)}}; }

Values files(std::vector<std::string> endings) {
  return {.files = true, .endings = std::move(endings)};
}

Values any_file() { return files({}); }

Values json_file() { return files({"json"}); }

Values folder() { return {.folders = true}; }

Values assets() { return {.files = true, .folders = true, .endings = {"gltf", "glb", "vrm"}}; }

Values pages() { return {.files = true, .folders = true, .endings = {"md"}}; }

Values pictures() { return files({"png", "webp", "jpeg", "jpg", "exr"}); }

Values pictures_or_folder() {
  Values values = pictures();
  values.folders = true;
  return values;
}

}  // namespace values

std::vector<WordSet> named_word_sets() {
  return {codes(), schema_names(), targets(), measure_names(), presets()};
}

}  // namespace gltfx::tool
