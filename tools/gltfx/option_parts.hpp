// SPDX-License-Identifier: Apache-2.0
/// Rows of options that several verbs have.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <set>
#include <string>

#include "option_rows.hpp"

namespace gltfx::tool {

inline constexpr const char* kAssetArguments = "Files, folders (recursive) or globs";

void add_asset_arguments(Options& options, NamedPaths& paths, const char* text = kAssetArguments);
/// --format of the verbs that print tables.
void add_table_format(Options& options, TableFormat& format);
/// --format of the verbs that write reports.
void add_report_formats(Options& options, ReportRequest& request);
/// --sarif-notes of the same verbs.
void add_sarif_notes(Options& options, ReportRequest& request);
/// How findings are listed.
void add_listing(Options& options, ReportRequest& request);
/// --fail-on of the verbs that give a verdict.
void add_fail_on(Options& options, std::optional<Severity>& level, const char* text,
                 ConfigKey key = {});
/// The key of --fail-on.
ConfigKey fail_on_key();
/// Options of the inputs of a run, besides the positional ones.
void add_inputs(Options& options, NamedPaths& paths);
/// Options of the search in folders; add_inputs() includes it.
void add_search(Options& options, NamedPaths& paths);
/// --root of the verbs that open files of assets.
void add_root(Options& options, std::string& root);
void add_cache(Options& options, CacheChoice& cache, const char* text);
void add_schema_sources(Options& options, Words& files, Words& folders);
/// --rules of the verbs that know codes.
void add_own_rules(Options& options, std::shared_ptr<const OwnRules>& rules);
/// Words that are codes, also of own rules.
Binding codes(Options& options, std::set<std::string, std::less<>>& member);
/// Options of engines, and files about further ones.
void add_targets(Options& options, std::vector<TargetChoice>& targets);
void add_target_files(Options& options);
template <class Quality>
void add_quality(Options& options, Quality& quality, const char* text, ConfigKey key = {}) {
  options.add("--quality", "NAME", text,
              one_of(quality, {{"draft", BakeQuality::draft},
                               {"standard", BakeQuality::standard},
                               {"final", BakeQuality::final}}),
              key);
}
void add_quiet(Options& options, bool& quiet, const char* text);
/// --config and --isolated; config_choice() reads them.
void add_configuration(Options& options);
/// --unsandboxed-decoders of the verbs that decode images and meshes.
void add_decoders(Options& options, CommonOptions& common);
/// --jobs and --color.
void add_common(Options& options, CommonOptions& common);
/// --color only, for a verb without threads.
void add_color(Options& options, CommonOptions& common);

/// Options that select findings, for the verbs that list or fix them.
void add_selection(Options& options, ValidateOptions& validation);
/// Options of the checks.
void add_checks(Options& options, ValidateOptions& validation);
/// All options that `gltfx validate` and `gltfx report` share.
void declare_checks(Options& options, ValidateRequest& request);

}  // namespace gltfx::tool
