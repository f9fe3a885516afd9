// SPDX-License-Identifier: Apache-2.0
/// Code shared by the verbs that change assets.
#pragma once

#include <gltfx/decoders.hpp>
#include <gltfx/edited_file.hpp>

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/text.hpp"
#include "commands.hpp"
#include "edit_json.hpp"
#include "input_paths.hpp"
#include "options.hpp"
#include "output.hpp"
#include "output_places.hpp"
#include "read_input.hpp"
#include "terminal.hpp"

namespace gltfx::tool {

/// A diff for standard output: unchanged for a file, otherwise without characters that control a
/// terminal, hide or reorder text. `raw`: with them. Prints a note if some are escaped.
std::string diff_text(std::string_view diff, bool raw);

/// "parent.gltf: external assets stay as they are: a.gltf, b.gltf"; empty: there are none.
std::string external_assets_text(const EditOutcome& report, std::string_view what);

/// Restores the copies that --backup kept. `root`: as in EditOptions.
ExitCode restore_all(const EditRequest& request, const std::string& root);

/// The exit code for a problem. Precondition: there is a problem.
ExitCode exit_code_of(EditProblem problem);

/// The parts of a verb that are optional. A verb has also
///
///   - the types Request, Options, Report and Summary,
///   - `Options options_of(const Request&)`, without schemas,
///   - `void run(inputs, options, jobs, consume)` of the library,
///   - `text(report, style)`, `summary_text(summary, writing)`, `json(report, first)` and
///     `json_end(summary)`, all as in fix_print.hpp,
///   - `bool is_finding(report, request, writing)`: whether a file without a problem makes the exit
///     code 1.
struct EditVerb {
  /// Why the options do not go with the schemas that they have now, or nothing.
  static std::optional<Error> check(const EditOptions& /*options*/) { return std::nullopt; }
  /// The output of each input.
  static Result<std::vector<EditInput>> place(const Inputs& named, const EditOptions& options) {
    return place_outputs(named, options.output);
  }
  /// What is said of EditOutcome::external_assets.
  static constexpr std::string_view external_assets = "external assets stay as they are";
  /// Prints what a diff cannot hold.
  static void note_beside_diff(const EditOutcome& /*report*/) {}
};

/// A run of a verb on its inputs.
template <class Verb>
class EditRun {
 public:
  using Request = typename Verb::Request;
  using Report = typename Verb::Report;

  EditRun(const Request& request, typename Verb::Options options)
      : request_(request),
        options_(std::move(options)),
        style_(colors_on_stdout(request.common.color)) {}

  ExitCode execute() {
    const auto named = expand_paths(request_.paths, request_.quiet);
    const auto inputs =
        named ? Verb::place(*named, options_) : Result<std::vector<EditInput>>(named.error());
    if (!inputs) {
      complain(inputs.error().message);
      return ExitCode::usage;
    }
    if (as_json()) say(edit_json_begin());
    options_.searched = named->searched;
    Verb::run(*inputs, options_, request_.common.jobs, [this](Report&& report) { take(report); });
    if (as_json()) {
      say(Verb::json_end(summary_));
    } else if (!request_.quiet) {
      finish(Verb::summary_text(summary_, writing()));
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

  void take(const Report& report) {
    if (as_json()) say(Verb::json(report, summary_.files + summary_.unreadable == 0));
    summary_.add(report);
    if (!as_json()) show(report);
    if (report.problem != EditProblem::none) {
      complain(printable(report.path) + ": " + printable(report.error));
      code_ = worse(code_, exit_code_of(report.problem));
    } else if (Verb::is_finding(report, request_, writing())) {
      code_ = worse(code_, ExitCode::findings);
    }
  }

  void show(const Report& report) {
    if (options_.diff) {
      say(diff_text(report.diff, request_.raw));
      if (request_.quiet) return;
      Verb::note_beside_diff(report);
      const std::string note = external_assets_text(report, Verb::external_assets);
      if (!note.empty()) complain(note);
    } else if (!request_.quiet) {
      say(Verb::text(report, style_));
      const std::string note = external_assets_text(report, Verb::external_assets);
      if (!note.empty()) say(wrapped(note, 0));
    }
  }

  const Request& request_;
  typename Verb::Options options_;
  const Style style_;
  typename Verb::Summary summary_;
  ExitCode code_ = ExitCode::ok;
};

/// Runs a verb.
template <class Verb>
ExitCode run_edit(const typename Verb::Request& request) {
  typename Verb::Options options = Verb::options_of(request);
  if (request.restore) return restore_all(request, options.root);
  permit_unsandboxed_decoders(request.common.unsandboxed_decoders);
  auto problem = check_root(options.root);
  if (!problem) {
    auto schemas = load_schemas(request.schema_files, request.schema_folders);
    if (schemas) options.schemas = *std::move(schemas);
    problem = schemas ? Verb::check(options) : std::optional<Error>(schemas.error());
  }
  if (problem) {
    complain(problem->message);
    return ExitCode::usage;
  }
  return EditRun<Verb>(request, std::move(options)).execute();
}

}  // namespace gltfx::tool
