// SPDX-License-Identifier: Apache-2.0
#include "command_line_parts.hpp"

#include <CLI/CLI.hpp>

namespace gltfx::tool {
namespace {

OptionEntry entry_of(const CLI::Option& option) {
  OptionEntry entry;
  if (!option.get_snames().empty()) entry.short_name = "-" + option.get_snames().front();
  if (!option.get_lnames().empty()) entry.name = "--" + option.get_lnames().front();
  entry.text = option.get_description();
  entry.repeatable = option.get_items_expected_max() > 1;
  if (option.get_items_expected_max() > 0) entry.type = option.get_type_name();
  return entry;
}

CommandEntry entry_of(const CLI::App& app, std::string name) {
  CommandEntry entry{std::move(name), app.get_description(), {}, {}, {}};
  for (const CLI::Option* option : app.get_options()) {
    if (option->get_positional()) {
      entry.positional = option->get_name();
      entry.positional_text = option->get_description();
    } else {
      entry.options.push_back(entry_of(*option));
    }
  }
  return entry;
}

}  // namespace

void describe_positional(CLI::App& app, const char* name, const char* text) {
  app.add_option(name)->description(text)->type_name("...")->expected(0);
}

// CLI11 would let such an option swallow every positional after its value unless extra arguments
// are refused.
void add_list(CLI::App& app, const char* name, std::vector<std::string>& words, const char* type,
              const char* text) {
  app.add_option(name, words, text)->type_name(type)->allow_extra_args(false);
}

void add_word(CLI::App& app, const char* name, std::string& word, const char* type,
              const char* text) {
  app.add_option(name, word, text)->type_name(type)->take_last();
}

void add_formats(CLI::App& app, std::vector<std::string>& formats) {
  add_list(app, "-f,--format", formats, "NAME[=FILE]",
           "text|json|jsonl|khronos|github|sarif|junit|agent");
}

void add_sarif_notes(CLI::App& app, bool& sarif_notes) {
  app.add_flag("--sarif-notes", sarif_notes, "Include info and hint in SARIF");
}

void add_inputs(CLI::App& app, RawInputOptions& words) {
  add_word(app, "--files-from", words.files_from, "FILE",
           "Read paths from FILE, separated by newline or NUL");
  add_word(app, "--shard", words.shard, "I/N", "Only part I of N of the files, split by path");
  add_search(app, words.exclude, words.no_ignore, words.allow_empty);
}

void add_search(CLI::App& app, std::vector<std::string>& exclude, bool& no_ignore,
                bool& allow_empty) {
  add_list(app, "--exclude", exclude, "GLOB", "Skip matches in folders and globs (repeatable)");
  app.add_flag("--no-ignore", no_ignore, "Include files that .gitignore excludes");
  app.add_flag("--allow-empty", allow_empty, "Exit 0 if there are no .gltf, .glb or .vrm files");
}

void add_listing(CLI::App& app, ListingWords& words) {
  add_word(app, "--min-severity", words.min_severity, "LEVEL",
           "Lowest severity to list: error, warning, info, hint");
  add_word(app, "--group-by", words.group_by, "WHAT",
           "Group text output by finding (default) or rule");
  app.add_flag("--statistics", words.statistics, "Print counts per rule and file only (text)");
}

void add_root(CLI::App& app, std::string& root) {
  add_word(app, "--root", root, "DIR", "Root of assets and resources (default: asset folder)");
}

void add_selection(CLI::App& app, RawValidateOptions& words) {
  add_word(app, "--profile", words.profile, "NAME",
           "default, khronos (as the Khronos validator), strict");
  add_list(app, "--select", words.select, "CODES",
           "Only these codes (comma-separated, repeatable)");
  add_list(app, "--ignore", words.ignore, "CODES", "Not these codes (comma-separated, repeatable)");
  add_list(app, "--severity", words.severities, "CODE=LEVEL", "Severity of a code (repeatable)");
  app.add_flag_callback(
      "--inline-suppressions", [&words] { words.inline_suppressions = "true"; },
      "Apply suppressions in extras.gltfx, also of errors");
}

void add_fail_on(CLI::App& app, std::string& level, const char* text) {
  add_word(app, "--fail-on", level, "LEVEL", text);
}

void add_common(CLI::App& app, RawCommonOptions& words) {
  add_word(app, "-j,--jobs", words.jobs, "N", "Number of threads (default: one per core)");
  add_color(app, words);
}

void add_color(CLI::App& app, RawCommonOptions& words) {
  add_word(app, "--color", words.color, "WHEN", "Color: auto (default), always or never");
}

void add_decoders(CLI::App& app, RawCommonOptions& words) {
  app.add_flag("--unsandboxed-decoders", words.unsandboxed_decoders,
               "Run decoders if the system cannot sandbox them");
}

void add_schema_sources(CLI::App& app, std::vector<std::string>& files,
                        std::vector<std::string>& folders) {
  add_list(app, "--schema", files, "FILE", "Add or replace an extension schema (repeatable)");
  add_list(app, "--schema-dir", folders, "DIR", "Add each *.schema.json of a folder (repeatable)");
}

void add_targets(CLI::App& app, std::vector<std::string>& names, std::vector<std::string>& files) {
  add_list(app, "--target", names, "NAME[@VERSION]",
           "What an engine refuses or ignores (repeatable)");
  add_target_files(app, files);
}

void add_target_files(CLI::App& app, std::vector<std::string>& files) {
  add_list(app, "--target-file", files, "FILE", "Add or replace an engine (repeatable)");
}

void add_configuration(CLI::App& app, ConfigChoice& choice) {
  add_word(app, "--config", choice.config, "FILE",
           "Configuration (default: the nearest gltfx.toml)");
  app.add_flag("--isolated", choice.isolated, "Ignore configuration files");
}

std::vector<CommandEntry> table_of(const CLI::App& program) {
  std::vector<CommandEntry> table{entry_of(program, {})};
  for (const CLI::App* verb : program.get_subcommands(nullptr)) {
    table.push_back(entry_of(*verb, verb->get_name()));
  }
  return table;
}

}  // namespace gltfx::tool
