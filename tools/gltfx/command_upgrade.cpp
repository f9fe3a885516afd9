// SPDX-License-Identifier: Apache-2.0
#include <gltfx/decoders.hpp>
#include <gltfx/pipeline.hpp>

#include <algorithm>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "base/text.hpp"
#include "commands.hpp"
#include "edit_run.hpp"
#include "input_paths.hpp"
#include "output_places.hpp"
#include "read_input.hpp"
#include "schema/compile.hpp"
#include "schema_words.hpp"
#include "steps/upgrade/choice.hpp"
#include "upgrade_print.hpp"

namespace gltfx::tool {
namespace {

// An Error about the first unknown name.
std::optional<Error> unknown_name(std::string_view option, const std::vector<std::string>& wanted,
                                  const std::vector<std::string>& known) {
  for (const std::string& name : wanted) {
    if (std::find(known.begin(), known.end(), name) != known.end()) continue;
    return Error{fmt::format("{}: {} is not one of {}.", option, gltfx::quoted(name),
                             fmt::join(known, ", "))};
  }
  return std::nullopt;
}

Result<UpgradeOptions> options_of(const UpgradeRequest& request) {
  UpgradeOptions options = request.upgrade;
  if (auto problem = check_root(options.root)) return *std::move(problem);
  auto schemas = load_schemas(request.schema_files, request.schema_folders);
  if (!schemas) return schemas.error();
  options.schemas = *schemas ? *std::move(schemas) : schema::builtin_set();
  const schema::Set& set = *options.schemas;
  for (auto problem : {unknown_name("--generation", {options.generation}, generation_names(set)),
                       unknown_name("--only", options.only, upgrade::legacy_names(set)),
                       unknown_name("--to", options.to, upgrade::successor_names(set))}) {
    if (problem) return *std::move(problem);
  }
  return options;
}

/// A run of inputs through the upgrade.
class UpgradeRun {
 public:
  UpgradeRun(const UpgradeRequest& request, UpgradeOptions options)
      : request_(request),
        options_(std::move(options)),
        style_(colors_on_stdout(request.common.color)) {}

  ExitCode execute() {
    const auto named = expand_paths(request_.paths, request_.quiet);
    const auto inputs = named ? place_outputs(*named, options_.output)
                              : Result<std::vector<EditInput>>(named.error());
    if (!inputs) {
      complain(inputs.error().message);
      return ExitCode::usage;
    }
    if (as_json()) say(upgrade_json_begin());
    options_.searched = named->searched;
    upgrade_files(*inputs, options_, request_.common.jobs,
                  [this](UpgradeReport&& report) { take(report); });
    if (as_json()) {
      say(upgrade_json_end(summary_));
    } else if (!request_.quiet) {
      finish(upgrade_summary_text(summary_, writing()));
    }
    return code_;
  }

 private:
  bool as_json() const { return request_.format == TableFormat::json; }
  bool writing() const { return options_.in_place || !options_.output.empty(); }
  void say(std::string_view text) { code_ = worse(code_, print(text)); }

  // Standard output is only the diff, so that it can be applied.
  void finish(std::string_view summary) {
    if (!options_.diff) return say(summary);
    complain(summary.substr(0, summary.size() - 1));
  }

  // Notes of the plan that a diff cannot hold.
  static void note_beside_diff(const UpgradeReport& report) {
    const std::string path = printable(report.path);
    for (const std::string& file : report.new_files) {
      complain(fmt::format("note: {}: the diff lacks the new file {}, which it refers to", path,
                           printable(file)));
    }
    for (const std::string& warning : report.new_warnings) {
      complain(fmt::format("note: {}: new warning: {}", path, printable(warning)));
    }
    if (!report.not_verified.empty()) {
      complain(fmt::format("note: {}: not verified: {}", path, printable(report.not_verified)));
    }
  }

  void take(const UpgradeReport& report) {
    if (as_json()) say(upgrade_json(report, summary_.files + summary_.unreadable == 0));
    summary_.add(report);
    if (!as_json()) show(report);
    if (report.problem != EditProblem::none) {
      complain(fmt::format("{}: {}", printable(report.path), report.error));
    }
    code_ = worse(code_, verdict(report));
  }

  void show(const UpgradeReport& report) {
    if (options_.diff) {
      say(diff_text(report.diff, request_.raw));
      if (!request_.quiet) note_beside_diff(report);
    } else if (!request_.quiet) {
      say(upgrade_plan_text(report, style_));
    }
  }

  ExitCode verdict(const UpgradeReport& report) const {
    if (report.problem != EditProblem::none) return exit_code_of(report.problem);
    const bool unfinished = writing() && report.left() > 0;
    const bool to_do = request_.check && report.due() > 0;
    return unfinished || to_do ? ExitCode::findings : ExitCode::ok;
  }

  const UpgradeRequest& request_;
  UpgradeOptions options_;
  const Style style_;
  UpgradeSummary summary_;
  ExitCode code_ = ExitCode::ok;
};

}  // namespace

ExitCode run(const UpgradeRequest& request) {
  if (request.restore) return restore_all(request, request.upgrade.root);
  permit_unsandboxed_decoders(request.common.unsandboxed_decoders);
  auto options = options_of(request);
  if (!options) {
    complain(options.error().message);
    return ExitCode::usage;
  }
  return UpgradeRun(request, *std::move(options)).execute();
}

}  // namespace gltfx::tool
