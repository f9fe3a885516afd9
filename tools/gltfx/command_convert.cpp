// SPDX-License-Identifier: Apache-2.0
#include <gltfx/decoders.hpp>
#include <gltfx/pipeline.hpp>

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "base/text.hpp"
#include "commands.hpp"
#include "convert_print.hpp"
#include "edit_run.hpp"
#include "fix_print.hpp"
#include "input_paths.hpp"
#include "output_places.hpp"
#include "read_input.hpp"

namespace gltfx::tool {
namespace {

Result<ConvertOptions> options_of(const ConvertRequest& request) {
  ConvertOptions options = request.convert;
  if (auto problem = check_root(options.root)) return *std::move(problem);
  auto schemas = load_schemas(request.schema_files, request.schema_folders);
  if (!schemas) return schemas.error();
  options.schemas = *std::move(schemas);
  return options;
}

// The name that an asset gets in a folder.
std::string stored_name(const std::string& place, StoredAs to) {
  const std::string ending = ending_of(place);
  const bool fits = to == StoredAs::glb ? ending == ".glb" || ending == ".vrm" : ending == ".gltf";
  if (fits) return place;
  return std::filesystem::path(place)
      .replace_extension(to == StoredAs::glb ? ".glb" : ".gltf")
      .native();
}

/// A run of inputs that are stored in another way.
class ConvertCommand {
 public:
  ConvertCommand(const ConvertRequest& request, ConvertOptions options)
      : request_(request),
        options_(std::move(options)),
        style_(colors_on_stdout(request.common.color)) {}

  ExitCode execute() {
    auto named = expand_paths(request_.paths, request_.quiet);
    if (named) rename(*named);
    const auto inputs = named ? place_outputs(*named, options_.output, Ending::may_change)
                              : Result<std::vector<EditInput>>(named.error());
    if (!inputs) {
      complain(inputs.error().message);
      return ExitCode::usage;
    }
    if (as_json()) say(fix_json_begin());
    options_.searched = named->searched;
    options_.shared_folder = named->several;
    convert_files(*inputs, options_, request_.common.jobs,
                  [this](ConvertReport&& report) { take(report); });
    if (as_json()) {
      say(convert_json_end(summary_));
    } else if (!request_.quiet) {
      finish(convert_summary_text(summary_, writing()));
    }
    return code_;
  }

 private:
  bool as_json() const { return request_.format == TableFormat::json; }
  bool writing() const { return options_.in_place || !options_.output.empty(); }
  void say(std::string_view text) { code_ = worse(code_, print(text)); }

  void rename(Inputs& named) const {
    if (!options_.to) return;
    for (auto* places : {&named.places, &named.places_of_others}) {
      for (std::string& place : *places) place = stored_name(place, *options_.to);
    }
  }

  // Standard output is the diff's alone, so that it can be applied.
  void finish(std::string_view summary) {
    if (!options_.diff) return say(summary);
    complain(summary.substr(0, summary.size() - 1));
  }

  void take(const ConvertReport& report) {
    if (as_json()) say(convert_json(report, summary_.files + summary_.unreadable == 0));
    summary_.add(report);
    if (options_.diff && !as_json()) {
      say(diff_text(report.diff, request_.raw));
    } else if (!as_json() && !request_.quiet) {
      say(convert_text(report, style_));
    }
    const bool to_do = request_.check && report.changes;
    if (to_do || report.refused() > 0) code_ = worse(code_, ExitCode::findings);
    if (report.problem == EditProblem::none) return;
    complain(fmt::format("{}: {}", printable(report.path), printable(report.error)));
    code_ = worse(code_, exit_code_of(report.problem));
  }

  const ConvertRequest& request_;
  ConvertOptions options_;
  const Style style_;
  ConvertSummary summary_;
  ExitCode code_ = ExitCode::ok;
};

}  // namespace

ExitCode run(const ConvertRequest& request) {
  if (request.restore) return restore_all(request, request.convert.root);
  permit_unsandboxed_decoders(request.common.unsandboxed_decoders);
  auto options = options_of(request);
  if (!options) {
    complain(options.error().message);
    return ExitCode::usage;
  }
  return ConvertCommand(request, *std::move(options)).execute();
}

}  // namespace gltfx::tool
