// SPDX-License-Identifier: Apache-2.0
#include "option_parts.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "input_paths.hpp"
#include "option_values.hpp"
#include "reading.hpp"
#include "target_choice.hpp"

namespace gltfx::tool {

void add_asset_arguments(Options& options, NamedPaths& paths, const char* text) {
  options.positional("PATH", text, list(paths.words, values::assets));
}

void add_table_format(Options& options, TableFormat& format) {
  options.add("-f,--format", "NAME", "Output format: text (default) or json",
              one_of(format, {{"text", TableFormat::text}, {"json", TableFormat::json}}));
}

void add_report_formats(Options& options, ReportRequest& request) {
  options.add("-f,--format", "NAME[=FILE]", "One of the formats below (default: text)",
              parsed_list(request.targets, parse_targets, values::report_format_choice));
}

void add_sarif_notes(Options& options, ReportRequest& request) {
  options.add("--sarif-notes", "", "Include info and hint in SARIF", flag(request.sarif_notes));
}

void add_listing(Options& options, ReportRequest& request) {
  options.add("--min-severity", "LEVEL", "Lowest severity to list: error, warning, info, hint",
              one_of(request.min_severity, {{"error", Severity::error},
                                            {"warning", Severity::warning},
                                            {"info", Severity::info},
                                            {"hint", Severity::hint}}));
  options.add(
      "--group-by", "WHAT", "Group text output by finding (default) or rule",
      one_of(request.layout, {{"finding", TextLayout::findings}, {"rule", TextLayout::by_rule}}));
  options.add("--statistics", "", "Print counts per rule and file only (text)",
              set_to(request.layout, TextLayout::statistics));
}

void add_fail_on(Options& options, std::optional<Severity>& level, const char* text,
                 ConfigKey key) {
  options.add("--fail-on", "LEVEL", text,
              one_of(level, {{"error", Severity::error},
                             {"warning", Severity::warning},
                             {"info", Severity::info},
                             {"never", std::nullopt}}),
              key);
}

ConfigKey fail_on_key() { return {.name = "fail-on", .place = 30, .otherwise = "error"}; }

void add_inputs(Options& options, NamedPaths& paths) {
  options.add(
      "--files-from", "FILE", "Read paths from FILE, separated by newline or NUL",
      parsed(
          paths.listed, [](std::string_view, const std::string& file) { return read_list(file); },
          values::any_file));
  options.add("--shard", "I/N", "Only part I of N of the files, split by path",
              parsed(paths.shard, parse_shard));
  add_search(options, paths);
}

void add_search(Options& options, NamedPaths& paths) {
  options.add("--exclude", "GLOB", "Skip matches in folders and globs (repeatable)",
              list(paths.exclude),
              {.name = "exclude",
               .form = ConfigForm::patterns,
               .place = 120,
               .otherwise = "nothing",
               .adds_up = true});
  options.add("--no-ignore", "", "Include files that .gitignore excludes", flag(paths.no_ignore));
  options.add("--allow-empty", "", "Exit 0 if there are no .gltf, .glb or .vrm files",
              flag(paths.allow_empty));
}

void add_root(Options& options, std::string& root) {
  options.add(
      "--root", "DIR", "Root of assets and resources (default: asset folder)",
      text(root, values::folder),
      {.name = "root", .form = ConfigForm::path, .place = 110, .otherwise = "the asset's folder"});
}

void add_cache(Options& options, CacheChoice& cache, const char* help) {
  options.add("--cache", "DIR", help, text(cache.folder, values::folder));
  options.add("--cache-key", "FILE", "Key of --cache (default: $GLTFX_CACHE_KEY)",
              text(cache.key_file, values::any_file));
}

void add_schema_sources(Options& options, Words& files, Words& folders) {
  options.add("--schema", "FILE", "Add or replace an extension schema (repeatable)",
              list(files, values::json_file),
              {.name = "schemas",
               .form = ConfigForm::files,
               .place = 130,
               .otherwise = "the built-in ones",
               .adds_up = true});
  options.add("--schema-dir", "DIR", "Add each *.schema.json of a folder (repeatable)",
              list(folders, values::folder),
              {.name = "schemas", .form = ConfigForm::folders, .place = 131, .adds_up = true});
}

void add_own_rules(Options& options, std::shared_ptr<const OwnRules>& rules) {
  options.add("--rules", "PATH", "Add own rules: pages or folders of them (repeatable)",
              parsed_list(
                  rules,
                  [&options](std::string_view, const Words& words) {
                    return Result<std::shared_ptr<const OwnRules>>(
                        options.own_pages ? options.own_pages->of(words) : nullptr);
                  },
                  values::pages),
              {.name = "rules",
               .form = ConfigForm::paths,
               .place = 65,
               .otherwise = "none",
               .by_path = true,
               .adds_up = true});
}

Binding codes(Options& options, std::set<std::string, std::less<>>& member) {
  return parsed_list(
      member,
      [&options](std::string_view option, const Words& words) {
        return parse_codes(option, words, options.own_rules().get());
      },
      values::code_list);
}

void add_targets(Options& options, std::vector<TargetChoice>& targets) {
  options.add("--target", "NAME[@VERSION]", "What an engine refuses or ignores (repeatable)",
              parsed_list(
                  targets,
                  [&options](std::string_view, const Words& words) {
                    return read_targets(words, options.words("--target-file"));
                  },
                  values::target_list),
              {.name = "targets",
               .form = ConfigForm::names,
               .place = 100,
               .otherwise = "none",
               .by_path = true});
  add_target_files(options);
}

void add_target_files(Options& options) {
  options.add("--target-file", "FILE", "Add or replace an engine (repeatable)",
              {.values = values::json_file, .repeatable = true});
}

void add_quiet(Options& options, bool& quiet, const char* text) {
  options.add("-q,--quiet", "", text, flag(quiet));
}

void add_configuration(Options& options) {
  options.add("--config", "FILE", "Configuration (default: the nearest gltfx.toml)",
              {.values = [] { return values::files({"toml"}); }});
  options.add("--isolated", "", "Ignore configuration files", {});
}

void add_decoders(Options& options, CommonOptions& common) {
  options.add("--unsandboxed-decoders", "", "Run decoders if the system cannot sandbox them",
              flag(common.unsandboxed_decoders));
}

void add_common(Options& options, CommonOptions& common) {
  options.add("-j,--jobs", "N", "Number of threads (default: one per core)",
              parsed(common.jobs, parse_jobs));
  add_color(options, common);
}

void add_color(Options& options, CommonOptions& common) {
  options.add("--color", "WHEN", "Color: auto (default), always or never",
              one_of(common.color, {{"auto", ColorMode::automatic},
                                    {"always", ColorMode::always},
                                    {"never", ColorMode::never}}));
}

void Reading::require_inputs(std::string_view verb) {
  if (options_.hook) {
    return require(options_.words("--files-from").empty() && options_.words("--shard").empty(),
                   "hook: the commit says which files; leave out --files-from and --shard.");
  }
  const Words& paths = options_.arguments().words;
  require(!paths.empty() || !options_.words("--files-from").empty(),
          fmt::format("{}: name at least one file, folder or glob.", verb));
  require(options_.word("--files-from") != "-" || std::count(paths.begin(), paths.end(), "-") == 0,
          "--files-from: standard input is either a list or an asset.");
}

void Reading::require_files(std::string_view verb, std::string_view done) {
  const Words& paths = options_.arguments().words;
  require(std::count(paths.begin(), paths.end(), "-") == 0,
          fmt::format("{}: standard input has no file beside which anything could be {}; "
                      "name a file ('./-' for one named '-').",
                      verb, done));
}

void Reading::require_companions() {
  require(!options_.given("--statistics") || !options_.given("--group-by"),
          "--statistics and --group-by exclude each other.");
  require(!options_.given("--cache-key") || options_.given("--cache"),
          "--cache-key seals what --cache keeps; name the folder with --cache.");
}

}  // namespace gltfx::tool
