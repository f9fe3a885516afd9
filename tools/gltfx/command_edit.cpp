// SPDX-License-Identifier: Apache-2.0
#include <gltfx/pipeline.hpp>

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "base/text.hpp"
#include "commands.hpp"
#include "delete_print.hpp"
#include "edit_run.hpp"
#include "fix_print.hpp"
#include "input_paths.hpp"
#include "output_places.hpp"
#include "read_input.hpp"

namespace gltfx::tool {
namespace {

Result<DeleteOptions> options_of(const DeleteRequest& request) {
  DeleteOptions options = request.deletion;
  if (auto problem = check_root(options.root)) return *std::move(problem);
  auto schemas = load_schemas(request.schema_files, request.schema_folders);
  if (!schemas) return schemas.error();
  options.schemas = *std::move(schemas);
  return options;
}

/// A run of deletions.
class DeleteCommand {
 public:
  DeleteCommand(const DeleteRequest& request, DeleteOptions options)
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
    delete_objects_in_files(*inputs, options_, request_.common.jobs,
                            [this](DeleteReport&& report) { take(report); });
    if (as_json()) {
      say(delete_json_end(summary_));
    } else if (!request_.quiet) {
      finish(delete_summary_text(summary_, writing()));
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

  void take(const DeleteReport& report) {
    if (as_json()) say(delete_json(report, summary_.files + summary_.unreadable == 0));
    summary_.add(report);
    if (options_.diff && !as_json()) {
      say(diff_text(report.diff, request_.raw));
    } else if (!as_json() && !request_.quiet) {
      say(delete_text(report, style_));
    }
    if (request_.check && report.changes) code_ = worse(code_, ExitCode::findings);
    if (report.problem == EditProblem::none) return;
    complain(fmt::format("{}: {}", printable(report.path), printable(report.error)));
    code_ = worse(code_, exit_code_of(report.problem));
  }

  const DeleteRequest& request_;
  DeleteOptions options_;
  const Style style_;
  DeleteSummary summary_;
  ExitCode code_ = ExitCode::ok;
};

}  // namespace

ExitCode run(const DeleteRequest& request) {
  if (request.restore) return restore_all(request, request.deletion.root);
  auto options = options_of(request);
  if (!options) {
    complain(options.error().message);
    return ExitCode::usage;
  }
  return DeleteCommand(request, *std::move(options)).execute();
}

}  // namespace gltfx::tool
