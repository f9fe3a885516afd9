// SPDX-License-Identifier: Apache-2.0
#include <gltfx/inspect.hpp>
#include <gltfx/pipeline.hpp>

#include <string>
#include <utility>

#include <fmt/format.h>

#include "base/text.hpp"
#include "commands.hpp"
#include "input_paths.hpp"
#include "inspect_text.hpp"
#include "pipeline/outline.hpp"
#include "read_input.hpp"
#include "terminal.hpp"

namespace gltfx::tool {
namespace {

/// A run of inputs; one asset is in memory at a time and thread.
class InspectRun {
 public:
  InspectRun(const InspectRequest& request, InspectOptions options)
      : request_(request),
        options_(std::move(options)),
        style_(colors_on_stdout(request.common.color)) {}

  ExitCode execute() {
    const auto inputs = expand_paths(request_.paths, request_.quiet);
    if (!inputs) {
      complain(inputs.error().message);
      return ExitCode::usage;
    }
    if (request_.format == InspectFormat::outline) return print_outlines(inputs->paths);
    std::string text;
    if (json()) writer_.begin(text);
    say(text);
    options_.searched = inputs->searched;
    inspect_files(inputs->paths, options_, request_.common.jobs,
                  [this](InspectReport&& report) { take(report); });
    text.clear();
    if (json()) writer_.end(text);
    say(text);
    return code_;
  }

 private:
  bool json() const { return request_.format == InspectFormat::json; }
  void say(const std::string& text) { code_ = worse(code_, print(text)); }

  // A file without an outline is no failure: git would stop at it.
  ExitCode print_outlines(const std::vector<std::string>& paths) {
    for (const std::string& path : paths) {
      if (paths.size() > 1) say(fmt::format("{}:\n", style_.bold(report::safe(path))));
      say(outline_file(path, options_));
    }
    return code_;
  }

  void take(const InspectReport& report) {
    std::string text;
    if (json()) {
      writer_.file(report, text);
    } else if (report.error.empty()) {
      text = first_ ? "" : "\n";
      text += inspect_text(report, request_.most, style_);
      first_ = false;
    }
    say(text);
    if (report.error.empty()) return;
    complain(fmt::format("{}: {}", printable(report.path), report.error));
    code_ = worse(code_, ExitCode::unreadable);
  }

  const InspectRequest& request_;
  InspectOptions options_;
  const Style style_;
  InspectWriter writer_;
  bool first_ = true;
  ExitCode code_ = ExitCode::ok;
};

}  // namespace

ExitCode run(const InspectRequest& request) {
  InspectOptions options = request.inspect;
  auto problem = check_root(options.root);
  auto schemas = load_schemas(request.schema_files, request.schema_folders);
  if (!problem && !schemas) problem = schemas.error();
  if (problem) {
    complain(problem->message);
    return ExitCode::usage;
  }
  options.schemas = *std::move(schemas);
  options.measures = request.format == InspectFormat::json;
  return InspectRun(request, std::move(options)).execute();
}

}  // namespace gltfx::tool
