// SPDX-License-Identifier: Apache-2.0
#include "configuration.hpp"

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <memory>
#include <system_error>
#include <utility>

#include <fmt/format.h>

#include "base/text.hpp"
#include "option_parts.hpp"
#include "path_pattern.hpp"
#include "presets.hpp"
#include "read_input.hpp"
#include "verb_options.hpp"

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

void put_first(Words& words, Words before) {
  before.insert(before.end(), words.begin(), words.end());
  words = std::move(before);
}

// A path that a file of that folder names, from the working folder.
std::string path_from_folder(const std::string& folder, const std::string& path) {
  std::error_code error;
  const fs::path here = fs::current_path(error);
  return (fs::path(folder) / path).lexically_normal().lexically_proximate(here).native();
}

// A code that the command line selects is enabled even if a file ignores it.
void drop_selected(Words& ignored, const Words& select, const OwnRules* own) {
  const auto asked = parse_codes("--select", select, own);
  if (!asked) return;
  Words left;
  for (std::string& word : ignored) {
    const std::vector<std::string_view> codes = codes_from_user(word, own);
    if (codes.empty()) left.push_back(std::move(word));  // reported later
    for (const std::string_view code : codes) {
      if (asked->count(code) == 0) left.emplace_back(code);
    }
  }
  ignored = std::move(left);
}

}  // namespace

/// Reads a file and what it extends. Depth and number are bounded: a file may be named often.
class Configuration::Loader {
 public:
  Loader(Configuration& to, const std::shared_ptr<OwnPages>& pages) : to_(to), pages_(pages) {}

  std::optional<Error> add(const fs::path& file, const std::string& shown) {
    std::error_code error;
    const auto text = read_text_file(file.native(), kLongestConfig);
    if (!text) return Error{"--config: " + text.error().message};
    return add_text(*text, fs::absolute(file, error).lexically_normal(), shown);
  }

 private:
  static constexpr std::size_t kDeepest = 16;
  static constexpr std::size_t kMost = 64;

  std::optional<Error> add_text(std::string_view text, const fs::path& whole,
                                const std::string& shown) {
    const std::string folder = whole.parent_path().native();
    const auto resolve = [&](const std::string& path) { return path_from_folder(folder, path); };
    auto content = parse_config(text, shown, resolve, pages_);
    if (!content) return content.error();
    open_.push_back(whole);
    for (const ConfigBase& base : content->extends) {
      if (auto problem = add_base(base, whole.parent_path())) {
        return Error{
            fmt::format("{}:{}: extends: {}", printable(shown), base.line, problem->message)};
      }
      if (to_.sources_.size() >= kMost) {
        return Error{fmt::format("{}:{}: extends: these are more than {} files and presets",
                                 printable(shown), base.line, kMost)};
      }
    }
    open_.pop_back();
    to_.sources_.push_back({shown, whole.parent_path().native(), *std::move(content)});
    return {};
  }

  std::optional<Error> add_base(const ConfigBase& base, const fs::path& folder) {
    if (!base.name.ends_with(".toml")) return add_preset(base.name);
    std::error_code error;
    const fs::path file = (folder / base.name).lexically_normal();
    if (std::find(open_.begin(), open_.end(), file) != open_.end()) {
      return Error{fmt::format("{} extends itself", gltfx::quoted(base.name, 200))};
    }
    if (open_.size() >= kDeepest) {
      return Error{fmt::format("there are more than {} files in a row", kDeepest)};
    }
    const auto text = read_text_file(file.native(), kLongestConfig);
    if (!text) return Error{text.error().message};
    const std::string shown = file.lexically_proximate(fs::current_path(error)).native();
    auto problem = add_text(*text, file, shown);
    to_.bases_.push_back(shown);
    return problem;
  }

  std::optional<Error> add_preset(const std::string& id) {
    auto preset = read_preset(id);
    if (!preset) return preset.error();
    ConfigSource source;
    source.content.limits = std::move(preset->limits);
    to_.sources_.push_back(std::move(source));
    to_.bases_.push_back(preset->origin());
    return {};
  }

  Configuration& to_;
  const std::shared_ptr<OwnPages>& pages_;
  std::vector<fs::path> open_;  // from the first file to the one that is read
};

Result<Configuration> Configuration::load(const ConfigChoice& choice,
                                          const std::shared_ptr<OwnPages>& pages) {
  Configuration found;
  if (!choice.config.empty() && choice.isolated) {
    return Error{"--config and --isolated are mutually exclusive."};
  }
  if (choice.isolated) return found;
  std::error_code error;
  const fs::path here = fs::current_path(error);
  const fs::path file = choice.config.empty() ? nearest_file(here) : fs::path(choice.config);
  if (file.empty()) return found;
  const fs::path whole = fs::absolute(file, error).lexically_normal();
  const std::string shown =
      choice.config.empty() ? whole.lexically_proximate(here).native() : choice.config;
  if (auto problem = Loader(found, pages).add(file, shown)) return *std::move(problem);
  return found;
}

bool Configuration::has_overrides() const {
  return std::any_of(sources_.begin(), sources_.end(),
                     [](const ConfigSource& source) { return !source.content.overrides.empty(); });
}

std::vector<std::size_t> Configuration::overrides_for(const std::string& path) const {
  std::vector<std::size_t> found;
  if (!has_overrides() || path == "-") return found;
  std::size_t position = 0;
  for (const ConfigSource& source : sources_) {
    if (source.content.overrides.empty()) continue;
    const std::string plain = path_for_patterns(path, source.folder);
    for (const ConfigOverride& one : source.content.overrides) {
      if (fits(one, plain)) found.push_back(position);
      ++position;
    }
  }
  return found;
}

std::vector<Configuration::Part> Configuration::parts(
    const std::vector<std::size_t>& overrides) const {
  std::vector<Part> found, all;
  for (const ConfigSource& source : sources_) {
    found.push_back({&source, &source.content, nullptr});
    for (const ConfigOverride& one : source.content.overrides) {
      all.push_back({&source, &one, &one});
    }
  }
  for (const std::size_t i : overrides) found.push_back(all[i]);
  return found;
}

std::vector<Holding> Configuration::holding(const ConfigKey& key,
                                            const std::vector<std::size_t>& overrides) const {
  std::vector<Holding> found;
  for (const auto& [source, part, because] : parts(overrides)) {
    bool fresh = true;
    for (const ConfigValue& value : part->values) {
      if (value.key.name != key.name) continue;
      if (fresh && !key.adds_up) found.clear();
      fresh = false;
      found.push_back({&value, because, source});
    }
  }
  return found;
}

std::vector<Limit> Configuration::limits(const std::vector<std::size_t>& overrides) const {
  std::vector<Limit> found;
  for (const Part& one : parts(overrides)) {
    for (const measure::LimitChange& change : one.part->limits) measure::apply(found, change);
  }
  return found;
}

// A pattern with a folder applies from the folder of the file; a name applies anywhere.
bool holds_anywhere(std::string_view pattern) {
  const std::size_t slash = pattern.find('/');
  return slash == std::string_view::npos || slash + 1 == pattern.size();
}

Words Configuration::words_of(const ConfigKey& key,
                              const std::vector<std::size_t>& overrides) const {
  Words words;
  const bool files = key.form == ConfigForm::files, folders = key.form == ConfigForm::folders;
  const bool patterns = key.form == ConfigForm::patterns;
  const bool paths =
      key.form == ConfigForm::path || key.form == ConfigForm::paths || files || folders || patterns;
  for (const Holding& one : holding(key, overrides)) {
    const std::string& word = one.value->word;
    const bool plain = !paths || (patterns && holds_anywhere(word));
    words.push_back(plain ? word : path_from_folder(one.source->folder, word));
  }
  if (files || folders) {
    std::error_code error;
    std::erase_if(words, [&](const auto& path) { return fs::is_directory(path, error) == files; });
  }
  return words;
}

void Configuration::fill(Options& options, const std::vector<std::size_t>& overrides) const {
  if (options.limits != nullptr) *options.limits = limits(overrides);
  for (Option& row : options.rows()) {
    if (row.key.name.empty()) continue;
    Words said = words_of(row.key, overrides);
    if (row.key.name == "ignore" && options.given("--select")) {
      drop_selected(said, options.words("--select"), options.own_rules().get());
    }
    if (row.key.adds_up || row.words.empty()) put_first(row.words, std::move(said));
  }
}

PathOptions::PathOptions(const Options& options, Configuration configuration)
    : own_pages_(options.own_pages), configuration_(std::move(configuration)) {
  for (const Option& row : options.rows()) {
    if (row.given) given_.emplace(row.name, row.words);
  }
}

void PathOptions::apply(const std::vector<std::size_t>& kind, ValidateOptions& options) const {
  ValidateRequest request;
  request.validation = std::move(options);
  Options rows;
  declare_checks(rows, request);
  rows.own_pages = own_pages_;
  for (Option& row : rows.rows()) {
    const auto words = given_.find(row.name);
    row.given = words != given_.end();
    if (row.given) row.words = words->second;
  }
  configuration_.fill(rows, kind);
  rows.read_by_path();
  options = std::move(request.validation);
}

ConfigChoice config_choice(const Options& options) {
  return {std::string(options.word("--config")), options.given("--isolated")};
}

std::optional<Error> configure(Options& options) {
  if (!options.has_keys() || options.runs_without_configuration()) return {};
  const auto pages = std::make_shared<OwnPages>();
  if (auto mistake = pages->read(options.words("--rules"))) {
    return Error{"--rules: " + mistake->message};
  }
  options.own_pages = pages;
  auto configuration = Configuration::load(config_choice(options), pages);
  if (!configuration) return configuration.error();
  if (configuration->has_overrides()) {
    options.by_path = std::make_shared<const PathOptions>(options, *configuration);
  }
  configuration->fill(options, {});
  return {};
}

std::vector<KeyedOption> keyed_options() {
  std::vector<KeyedOption> all;
  const auto add = [&](std::string_view verb, const Options& options) {
    for (const Option& row : options.rows()) {
      const auto same = [&](const KeyedOption& one) { return one.option.key.name == row.key.name; };
      if (!row.key.name.empty() && std::none_of(all.begin(), all.end(), same)) {
        all.push_back({verb, row});
      }
    }
  };
  Options validate_rows, bake_rows;
  ValidateRequest validate;
  BakeRequest bake;
  declare_checks(validate_rows, validate);
  declare_bake(bake_rows, bake);
  add("validate", validate_rows);
  add("bake", bake_rows);
  std::stable_sort(all.begin(), all.end(), [](const KeyedOption& a, const KeyedOption& b) {
    return a.option.key.place < b.option.key.place;
  });
  return all;
}

}  // namespace gltfx::tool
