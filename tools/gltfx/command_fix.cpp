// SPDX-License-Identifier: Apache-2.0
#include <gltfx/decoders.hpp>
#include <gltfx/pipeline.hpp>

#include <algorithm>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "base/text.hpp"
#include "commands.hpp"
#include "edit_run.hpp"
#include "fix_print.hpp"
#include "input_paths.hpp"
#include "output_places.hpp"
#include "read_input.hpp"

namespace gltfx::tool {
namespace {

Result<FixOptions> options_of(const FixRequest& request) {
  FixOptions options = request.fix;
  if (auto problem = check_root(options.root)) return *std::move(problem);
  auto schemas = load_schemas(request.schema_files, request.schema_folders);
  if (!schemas) return schemas.error();
  options.schemas = *std::move(schemas);
  return options;
}

/// A run of inputs through the fixes.
class FixRun {
 public:
  FixRun(const FixRequest& request, FixOptions options)
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
    if (as_json()) say(fix_json_begin());
    options_.searched = named->searched;
    fix_files(*inputs, options_, request_.common.jobs,
              [this](FixReport&& report) { take(report); });
    if (as_json()) {
      say(fix_json_end(summary_));
    } else if (!request_.quiet) {
      finish(fix_summary_text(summary_, writing()));
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

  void take(const FixReport& report) {
    if (as_json()) say(fix_json(report, summary_.files + summary_.unreadable == 0));
    summary_.add(report);
    if (!as_json()) show(report);
    if (report.problem != EditProblem::none) {
      complain(fmt::format("{}: {}", printable(report.path), printable(report.error)));
    }
    code_ = worse(code_, verdict(report));
  }

  void show(const FixReport& report) {
    if (!options_.diff) {
      if (!request_.quiet) say(fix_text(report, style_));
      return;
    }
    say(diff_text(report.diff, request_.raw));
    if (request_.quiet) return;
    for (const std::string& file : report.changed_files) {
      complain(fmt::format("note: {}: the diff lacks the changes of {}, to which it refers",
                           printable(report.path), printable(file)));
    }
  }

  ExitCode verdict(const FixReport& report) const {
    if (report.problem != EditProblem::none) return exit_code_of(report.problem);
    if (!request_.check || !report.changes) return ExitCode::ok;
    if (request_.fail_on == Severity::hint) return ExitCode::findings;
    const auto fails = [this](const FixAction& action) {
      return action.done && request_.fail_on && action.severity <= *request_.fail_on;
    };
    return std::any_of(report.actions.begin(), report.actions.end(), fails) ? ExitCode::findings
                                                                            : ExitCode::ok;
  }

  const FixRequest& request_;
  FixOptions options_;
  const Style style_;
  FixSummary summary_;
  ExitCode code_ = ExitCode::ok;
};

}  // namespace

ExitCode run(const FixRequest& request) {
  if (request.restore) return restore_all(request, request.fix.root);
  permit_unsandboxed_decoders(request.common.unsandboxed_decoders);
  auto options = options_of(request);
  if (!options) {
    complain(options.error().message);
    return ExitCode::usage;
  }
  return FixRun(request, *std::move(options)).execute();
}

}  // namespace gltfx::tool
