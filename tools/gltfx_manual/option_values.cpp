// SPDX-License-Identifier: Apache-2.0
#include "option_values.hpp"

#include <algorithm>
#include <functional>
#include <map>

#include "schema/compile.hpp"
#include "schema_words.hpp"
#include "upgrade/choice.hpp"
#include "value_words.hpp"

namespace gltfx::tool {
namespace {

template <class Texts>
WordSet set_of(const Texts& texts, std::string name = {}) {
  return {std::move(name), std::vector<std::string>(texts.begin(), texts.end())};
}

template <class T, std::size_t N>
WordSet set_of(const std::array<Word<T>, N>& words) {
  return set_of(word_names<T>(words));
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

Values choice(WordSet words) { return {.words = std::move(words)}; }
Values comma_list(WordSet words) { return {.words = std::move(words), .commas = true}; }
Values file(std::vector<std::string> endings) {
  return {.files = true, .endings = std::move(endings)};
}
Values picture() { return file({kPictureFormats.begin(), kPictureFormats.end()}); }
Values folder() { return {.folders = true}; }
Values picture_or_folder() {
  Values values = picture();
  values.folders = true;
  return values;
}
Values assets() { return {.files = true, .folders = true, .endings = {"gltf", "glb", "vrm"}}; }

Values severities() {
  WordSet levels;
  for (const Severity level :
       {Severity::error, Severity::warning, Severity::info, Severity::hint}) {
    levels.words.emplace_back(severity_name(level));
  }
  return {.words = codes(), .behind = std::move(levels)};
}

Values report_formats() { return {.words = set_of(report_format_names()), .file_behind = true}; }

std::vector<std::string> sorted_once(std::vector<std::string> names) {
  std::sort(names.begin(), names.end());
  names.erase(std::unique(names.begin(), names.end()), names.end());
  return names;
}

using Table = std::map<std::string, Values, std::less<>>;

// Options that mean the same with every verb that has them.
Table common_values() {
  const schema::Set& set = *schema::builtin_set();
  return {
      {"--format", choice(set_of(kTableFormatWords))},
      {"--status", choice(set_of(kStatusWords))},
      {"--fail-on", choice(set_of(kFailOnWords))},
      {"--min-severity", choice(set_of(kMinSeverityWords))},
      {"--group-by", choice(set_of(kGroupByWords))},
      {"--profile", choice(set_of(kProfileWords))},
      {"--select", comma_list(codes())},
      {"--ignore", comma_list(codes())},
      {"--skip", comma_list(codes())},
      {"--severity", severities()},
      {"--pixels", choice(set_of(kPixelWords))},
      {"--root", folder()},
      {"--lfs", choice(set_of(kLfsWords))},
      {"--target", comma_list(targets())},
      {"--target-file", file({"json"})},
      {"--schema", file({"json"})},
      {"--schema-dir", folder()},
      {"--files-from", file({})},
      {"--cache", folder()},
      {"--cache-key", file({})},
      {"--baseline", file({"json"})},
      {"--write-baseline", file({"json"})},
      {"--config", file({"toml"})},
      {"--color", choice(set_of(kColorWords))},
      {"--only", choice(set_of(sorted_once(upgrade::legacy_names(set))))},
      {"--to", choice(set_of(sorted_once(upgrade::successor_names(set))))},
      {"--ior", choice({{}, {"0", "1000"}})},
      {"--generation", choice(set_of(sorted_once(generation_names(set))))},
      {"--sheet", picture()},
      {"--layer", comma_list(set_of(kLayerWords))},
      {"--compare", file({"gltf", "glb", "vrm"})},
      {"--projection", choice(set_of(kProjectionWords))},
      {"--interior", choice(set_of(kInteriorWords))},
      {"--lights", choice(set_of(kLightWords))},
      {"--environment", file({"hdr", "exr"})},
      {"--quality", choice(set_of(kQualityWords))},
      {"--denoise", choice(set_of(kDenoiseWords))},
      {"--shader", choice(set_of(kShaderWords))},
  };
}

// Positional arguments, and options that another verb has too, for something else.
Table own_values() {
  return {
      {"validate --format", report_formats()},
      {"merge --format", report_formats()},
      {"bake --format", choice(set_of(kPictureFormats))},
      {"fix --output", assets()},
      {"fix --only", comma_list(codes())},
      {"fix ", assets()},
      {"upgrade --output", assets()},
      {"edit --output", assets()},
      {"edit ", assets()},
      {"bake --output", picture_or_folder()},
      {"report --output", file({"html"})},
      {"validate ", assets()},
      {"upgrade ", assets()},
      {"bake ", assets()},
      {"report ", assets()},
      {"inspect ", assets()},
      {"merge ", file({"jsonl"})},
      {"explain ", choice(codes())},
      {"targets --format", choice(set_of(kMatrixFormatWords))},
      {"targets ", choice(targets())},
      {"schema ", choice(schema_names())},
      {"config ", {.words = {{}, {"import"}}, .files = true, .folders = true}},
      {"hook ", choice({{}, {"validate", "fix", "upgrade"}})},
  };
}

}  // namespace

Values values_of(std::string_view verb, std::string_view option) {
  static const Table kCommon = common_values();
  static const Table kOwn = own_values();
  const auto own = kOwn.find(std::string(verb).append(" ").append(option));
  if (own != kOwn.end()) return own->second;
  const auto common = kCommon.find(option);
  return common == kCommon.end() ? Values() : common->second;
}

std::vector<WordSet> named_word_sets() { return {codes(), schema_names(), targets()}; }

}  // namespace gltfx::tool
