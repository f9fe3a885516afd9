// SPDX-License-Identifier: Apache-2.0
#include "configuration.hpp"

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <memory>
#include <system_error>
#include <utility>

#include "path_pattern.hpp"
#include "read_input.hpp"
#include "reading.hpp"

namespace gltfx::tool {
namespace {

namespace fs = std::filesystem;

// Empty when there is none.
fs::path nearest_file(const fs::path& start) {
  std::error_code error;
  for (fs::path folder = start; !folder.empty(); folder = folder.parent_path()) {
    if (fs::is_regular_file(folder / kConfigName, error)) return folder / kConfigName;
    if (folder == folder.root_path()) break;
  }
  return {};
}

// Below the folder of the configuration, or absolute without the first '/'.
std::string path_for_patterns(const std::string& path, const fs::path& folder) {
  std::error_code error;
  const fs::path whole = fs::absolute(path, error).lexically_normal();
  const fs::path below = whole.lexically_relative(folder);
  const bool outside = below.empty() || *below.begin() == "..";
  return (outside ? whole.relative_path() : below).native();
}

bool fits(const ConfigOverride& one, std::string_view path) {
  return std::any_of(one.paths.begin(), one.paths.end(),
                     [&](const std::string& pattern) { return fits_pattern(pattern, path); });
}

void put_first(std::vector<std::string>& words, std::vector<std::string> before) {
  before.insert(before.end(), words.begin(), words.end());
  words = std::move(before);
}

// Who asks for a code on the command line gets it, whatever a file leaves out.
void drop_selected(std::vector<std::string>& ignored, const std::vector<std::string>& select) {
  const auto asked = parse_codes("--select", select);
  if (!asked) return;
  std::erase_if(ignored, [&](const std::string& code) {
    const RuleDescription* rule = rule_from_user(code);
    return rule != nullptr && asked->count(rule->code) > 0;
  });
}

}  // namespace

Result<Configuration> Configuration::load(const ConfigChoice& choice) {
  Configuration found;
  if (!choice.config.empty() && choice.isolated) {
    return Error{"--config and --isolated are mutually exclusive."};
  }
  if (choice.isolated) return found;
  std::error_code error;
  const fs::path here = fs::current_path(error);
  const fs::path file = choice.config.empty() ? nearest_file(here) : fs::path(choice.config);
  if (file.empty()) return found;
  const auto text = read_text_file(file.native(), kLongestConfig);
  if (!text) return Error{"--config: " + text.error().message};
  const fs::path whole = fs::absolute(file, error).lexically_normal();
  found.shown_ = choice.config.empty() ? whole.lexically_proximate(here).native() : choice.config;
  found.folder_ = whole.parent_path().native();
  auto content = parse_config(*text, found.shown_);
  if (!content) return content.error();
  found.content_ = *std::move(content);
  return found;
}

std::vector<std::size_t> Configuration::overrides_for(const std::string& path) const {
  std::vector<std::size_t> found;
  if (!has_overrides() || path == "-") return found;
  const std::string plain = path_for_patterns(path, folder_);
  for (std::size_t i = 0; i < content_.overrides.size(); ++i) {
    if (fits(content_.overrides[i], plain)) found.push_back(i);
  }
  return found;
}

std::vector<Holding> Configuration::holding(const ConfigKey& key,
                                            const std::vector<std::size_t>& overrides) const {
  std::vector<Holding> found;
  const auto take = [&](const std::vector<ConfigValue>& values, const ConfigOverride* because) {
    bool fresh = true;
    for (const ConfigValue& value : values) {
      if (value.key != &key) continue;
      if (fresh && key.merge == ConfigMerge::last) found.clear();
      fresh = false;
      found.push_back({&value, because});
    }
  };
  take(content_.values, nullptr);
  for (const std::size_t i : overrides) take(content_.overrides[i].values, &content_.overrides[i]);
  return found;
}

std::string Configuration::path_from_file(const std::string& path) const {
  std::error_code error;
  const fs::path here = fs::current_path(error);
  return (fs::path(folder_) / path).lexically_normal().lexically_proximate(here).native();
}

std::vector<std::string> Configuration::words_of(const ConfigKey& key,
                                                 const std::vector<std::size_t>& overrides) const {
  const bool path = key.form == ConfigForm::path || key.form == ConfigForm::paths;
  std::vector<std::string> words;
  for (const Holding& one : holding(key, overrides)) {
    words.push_back(path ? path_from_file(one.value->word) : one.value->word);
  }
  return words;
}

// A pattern with a folder in it holds from the folder of the file; a name holds anywhere.
void Configuration::add_excludes(std::vector<std::string>& exclude) const {
  std::vector<std::string> more;
  for (const Holding& one : holding(*find_config_key("exclude"), {})) {
    const std::string& pattern = one.value->word;
    const std::size_t slash = pattern.find('/');
    const bool anywhere = slash == std::string::npos || slash + 1 == pattern.size();
    more.push_back(anywhere ? pattern : path_from_file(pattern));
  }
  put_first(exclude, std::move(more));
}

void Configuration::add_schemas(std::vector<std::string>& files,
                                std::vector<std::string>& folders) const {
  std::vector<std::string> more_files, more_folders;
  for (std::string& path : words_of(*find_config_key("schemas"), {})) {
    std::error_code error;
    (fs::is_directory(path, error) ? more_folders : more_files).push_back(std::move(path));
  }
  put_first(files, std::move(more_files));
  put_first(folders, std::move(more_folders));
}

RawValidateOptions Configuration::apply(RawValidateOptions words,
                                        const std::vector<std::size_t>& overrides) const {
  for (const ConfigKey& key : config_keys()) {
    if (key.form == ConfigForm::paths || (key.word == nullptr && key.words == nullptr)) continue;
    std::vector<std::string> said = words_of(key, overrides);
    if (said.empty()) continue;
    if (key.word != nullptr) {
      if ((words.*key.word).empty()) words.*key.word = std::move(said.front());
      continue;
    }
    std::vector<std::string>& list = words.*key.words;
    if (key.words == &RawValidateOptions::ignore) drop_selected(said, words.select);
    if (key.merge == ConfigMerge::all) {
      put_first(list, std::move(said));
    } else if (list.empty()) {
      list = std::move(said);
    }
  }
  add_schemas(words.schema_files, words.schema_folders);
  add_excludes(words.inputs.exclude);
  return words;
}

void Configuration::fill(std::string_view key, std::string& word) const {
  std::vector<std::string> said = words_of(*find_config_key(key), {});
  if (word.empty() && !said.empty()) word = std::move(said.front());
}

void Configuration::apply(RawUpgradeOptions& words) const {
  apply(static_cast<RawEditOptions&>(words));
  if (words.targets.empty()) words.targets = words_of(*find_config_key("targets"), {});
}

void Configuration::apply(RawFixOptions& words) const {
  apply(static_cast<RawEditOptions&>(words));
  fill("fail-on", words.validate.fail_on);
}

void Configuration::apply(RawEditOptions& words) const {
  fill("root", words.root);
  add_excludes(words.inputs.exclude);
  add_schemas(words.schema_files, words.schema_folders);
}

void Configuration::apply(RawBakeOptions& words) const {
  fill("root", words.root);
  fill("environment", words.environment);
  fill("quality", words.quality);
  fill("projection", words.projection);
  fill("frame", words.frame);
  fill("interior", words.interior);
  add_excludes(words.inputs.exclude);
  add_schemas(words.schema_files, words.schema_folders);
}

void Configuration::apply(RawInspectOptions& words) const {
  fill("root", words.root);
  add_excludes(words.exclude);
  add_schemas(words.schema_files, words.schema_folders);
}

void Configuration::apply(RawSchemaOptions& words) const {
  add_schemas(words.schema_files, words.schema_folders);
}

// Every value was read once when the file was: it cannot fail here.
void PathOptions::apply(const std::vector<std::size_t>& kind, ValidateOptions& options) const {
  auto request = request_of(configuration_.apply(words_, kind));
  if (!request) return;
  ValidateOptions& own = request->validation;
  options.select = std::move(own.select);
  options.ignore = std::move(own.ignore);
  options.severity = std::move(own.severity);
  options.targets = std::move(own.targets);
  options.budgets = own.budgets;
  options.lfs = own.lfs;
  options.inline_suppressions = own.inline_suppressions;
}

Result<ValidateRequest> configured(const RawValidateOptions& words) {
  auto configuration = Configuration::load(words.configuration);
  if (!configuration) return configuration.error();
  auto request = request_of(configuration->apply(words, {}));
  if (request && configuration->has_overrides()) {
    request->by_path = std::make_shared<const PathOptions>(words, *std::move(configuration));
  }
  return request;
}

Result<PageRequest> configured(const RawPageOptions& words) {
  const RawInputOptions& inputs = words.validate.inputs;
  Reading reading;
  reading.require(!inputs.paths.empty() || !inputs.files_from.empty(),
                  "report: name at least one file, folder or glob.");
  require_files(reading, inputs.paths, "report");
  if (!reading.problem().empty()) return Error{reading.problem()};
  auto validate = configured(words.validate);
  if (!validate) return validate.error();
  return request_of(words, *std::move(validate));
}

namespace {

template <class Wanted, class Words>
Result<Wanted> request_with_configuration(Words words) {
  const auto configuration = Configuration::load(words.configuration);
  if (!configuration) return configuration.error();
  configuration->apply(words);
  return request_of(words);
}

}  // namespace

Result<UpgradeRequest> configured(RawUpgradeOptions words) {
  return request_with_configuration<UpgradeRequest>(std::move(words));
}

Result<FixRequest> configured(RawFixOptions words) {
  words.validate.configuration = words.configuration;
  words.validate.hook = true;  // its inputs are those of the verb
  const auto validate = configured(words.validate);
  if (!validate) return validate.error();
  auto request = request_with_configuration<FixRequest>(std::move(words));
  if (!request) return request;
  request->fix.validation = [common = validate->validation,
                             by_path = validate->by_path](const std::string& path) {
    ValidateOptions options = common;
    if (by_path) by_path->apply(by_path->kind_of(path), options);
    return options;
  };
  return request;
}

Result<DeleteRequest> configured(RawDeleteOptions words) {
  return request_with_configuration<DeleteRequest>(std::move(words));
}

Result<BakeRequest> configured(RawBakeOptions words) {
  return request_with_configuration<BakeRequest>(std::move(words));
}

Result<InspectRequest> configured(RawInspectOptions words) {
  return request_with_configuration<InspectRequest>(std::move(words));
}

Result<SchemaRequest> configured(RawSchemaOptions words) {
  return request_with_configuration<SchemaRequest>(std::move(words));
}

}  // namespace gltfx::tool
