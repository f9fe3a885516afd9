// SPDX-License-Identifier: Apache-2.0
/// How options are told to CLI11.
#pragma once

#include <string>
#include <vector>

#include "command_table.hpp"
#include "raw_options.hpp"

namespace CLI {
class App;
}

namespace gltfx::tool {

/// For the help only. CLI11 reads a positional "[a].gltf" as a list of its own, so that positionals
/// are declared to take nothing and are picked from what is left over.
void describe_positional(CLI::App& app, const char* name, const char* text);

/// An option that may be given several times.
void add_list(CLI::App& app, const char* name, std::vector<std::string>& words, const char* type,
              const char* text);

/// An option of which the last one counts.
void add_word(CLI::App& app, const char* name, std::string& word, const char* type,
              const char* text);

/// --format of the verbs that write reports.
void add_formats(CLI::App& app, std::vector<std::string>& formats);

/// --sarif-notes of the same verbs.
void add_sarif_notes(CLI::App& app, bool& sarif_notes);

/// Which of the inputs a run takes, besides the positional ones.
void add_inputs(CLI::App& app, RawInputOptions& words);

/// --allow-empty of the verbs that open assets; add_inputs() has it.
/// Which assets of folders count.
void add_search(CLI::App& app, std::vector<std::string>& exclude, bool& no_ignore,
                bool& allow_empty);
void add_listing(CLI::App& app, ListingWords& words);

/// --root of the verbs that open what assets refer to.
void add_root(CLI::App& app, std::string& root);

/// Which findings count, of the verbs that list or fix them.
void add_selection(CLI::App& app, RawValidateOptions& words);

/// --fail-on of the verbs that give a verdict.
void add_fail_on(CLI::App& app, std::string& level, const char* text);

void add_common(CLI::App& app, RawCommonOptions& words);
/// Of the common options, what a verb without threads has use for.
void add_color(CLI::App& app, RawCommonOptions& words);
/// The options of the verbs that decode images and meshes.
void add_decoders(CLI::App& app, RawCommonOptions& words);
void add_schema_sources(CLI::App& app, std::vector<std::string>& files,
                        std::vector<std::string>& folders);

/// What engines are named, and files about others.
void add_targets(CLI::App& app, std::vector<std::string>& names, std::vector<std::string>& files);
void add_target_files(CLI::App& app, std::vector<std::string>& files);

void add_configuration(CLI::App& app, ConfigChoice& choice);

/// The options of `gltfx bake`.
void declare_bake(CLI::App& app, RawBakeOptions& words);
/// The options of `gltfx validate`, and of `gltfx report` which asks for most of them, too.
void declare_validate(CLI::App& app, RawValidateOptions& words);
void declare_report(CLI::App& app, RawPageOptions& words);
/// The options of `gltfx upgrade`.
void declare_upgrade(CLI::App& app, RawUpgradeOptions& words);
/// The options of `gltfx fix`.
void declare_fix(CLI::App& app, RawFixOptions& words);
/// The options of `gltfx edit`.
void declare_edit(CLI::App& app, RawDeleteOptions& words);
/// The options of `gltfx inspect`.
void declare_inspect(CLI::App& app, RawInspectOptions& words);
/// The options of `gltfx merge`.
void declare_merge(CLI::App& app, RawMergeOptions& words);
/// The options of `gltfx config`.
void declare_config(CLI::App& app, RawConfigOptions& words);
void declare_explain(CLI::App& app, RawExplainOptions& words);
void declare_rules(CLI::App& app, RawRulesOptions& words);
void declare_targets(CLI::App& app, RawTargetsOptions& words);
void declare_schema(CLI::App& app, RawSchemaOptions& words);

/// What CLI11 was told, the program first, then its verbs.
std::vector<CommandEntry> table_of(const CLI::App& program);

}  // namespace gltfx::tool
