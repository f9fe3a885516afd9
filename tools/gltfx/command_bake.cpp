// SPDX-License-Identifier: Apache-2.0
#include <gltfx/decoders.hpp>
#include <gltfx/pipeline.hpp>
#include <gltfx/result_cache.hpp>

#include <cmath>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "base/text.hpp"
#include "commands.hpp"
#include "input_paths.hpp"
#include "output_places.hpp"
#include "progress.hpp"
#include "read_input.hpp"
#include "terminal.hpp"
#include "validation_options.hpp"

namespace gltfx::tool {
namespace {

ExitCode verdict(const BakeReport& report) {
  switch (report.problem) {
    case BakeProblem::none:
      return ExitCode::ok;
    case BakeProblem::unreadable:
      return ExitCode::unreadable;
    case BakeProblem::not_written:
      return ExitCode::internal;
    case BakeProblem::invalid:
    case BakeProblem::nothing_to_see:
    case BakeProblem::refused:
      break;
  }
  return ExitCode::findings;
}

/// A run of inputs through the renderer.
class BakeRun {
 public:
  BakeRun(const BakeRequest& request, BakeOptions options)
      : request_(request), options_(std::move(options)), progress_(!request.quiet, true) {
    if (progress_.visible()) options_.progress = [this](double part) { progress_.show(part); };
  }

  ExitCode execute() {
    const auto named = expand_paths(request_.paths, request_.quiet);
    if (named) options_.searched = named->searched;
    if (named && !request_.compare.empty()) return compare(*named);
    const auto places =
        named ? place_pictures(*named, request_) : Result<PicturePlaces>(named.error());
    if (!places) {
      complain(places.error().message);
      return ExitCode::usage;
    }
    const std::string trouble = bake_files(places->inputs, options_, places->sheet,
                                           [this](BakeReport&& report) { take(report); });
    progress_.clear();
    if (options_.cache) finish_cache();
    if (!trouble.empty()) {
      complain(fmt::format("{}: {}", printable(places->sheet), trouble));
      code_ = worse(code_, ExitCode::internal);
    } else if (!places->sheet.empty()) {
      say(fmt::format("{}\n", printable(places->sheet)));
    }
    return code_;
  }

 private:
  void say(const std::string& text) {
    if (!request_.quiet) code_ = worse(code_, print(text));
  }

  void finish_cache() {
    const std::string problem = options_.cache->finish();
    if (problem.empty()) return;
    complain(problem);
    code_ = worse(code_, ExitCode::internal);
  }

  void take(const BakeReport& report) {
    progress_.clear();
    const std::string name = printable(report.path);
    if (report.problem == BakeProblem::invalid) print_diagnostics(report.validation);
    if (!request_.quiet) {
      for (const std::string& note : report.notes) {
        complain(fmt::format("note: {}: {}", name, printable(note)));
      }
    }
    for (const std::string& file : report.written) {
      say(fmt::format("{} -> {}\n", name, printable(file)));
    }
    if (report.embedded) say(fmt::format("{}: thumbnail embedded\n", name));
    if (report.problem != BakeProblem::none) {
      complain(fmt::format("{}: {}", name, printable(report.error)));
    }
    code_ = worse(code_, verdict(report));
  }

  void print_diagnostics(const FileReport& report) {
    FormatOptions format;
    format.color = colors_on_stdout(request_.common.color);
    format.quiet = true;
    format.command = "gltfx";
    const auto writer = make_report_writer(ReportFormat::text, format);
    std::string text;
    writer->begin(text);
    writer->file(report, text);
    writer->end(RunSummary(), text);
    code_ = worse(code_, print(text));
  }

  ExitCode compare(const Inputs& named) {
    if (named.paths.size() != 1) {
      complain("--compare: name one file to compare with.");
      return ExitCode::usage;
    }
    if (const auto wrong = check_difference_name(request_)) {
      complain(wrong->message);
      return ExitCode::usage;
    }
    const BakeComparison compared =
        bake_comparison(named.paths.front(), request_.compare, options_);
    take(compared.first);
    take(compared.second);
    if (code_ != ExitCode::ok) return code_;
    if (!compared.error.empty()) {
      complain(fmt::format("{}: {}", printable(options_.output), compared.error));
      return ExitCode::internal;
    }
    const std::string figure =
        std::isinf(compared.psnr)
            ? std::string("the same picture")
            : fmt::format("PSNR {:.2f} dB, SSIM {:.4f}", compared.psnr, compared.ssim);
    code_ = worse(code_, print(figure + "\n"));
    return code_;
  }

  const BakeRequest& request_;
  BakeOptions options_;
  ProgressLine progress_;
  ExitCode code_ = ExitCode::ok;
};

}  // namespace

ExitCode run(const BakeRequest& request) {
  if (!can_bake()) {
    complain("bake: this build cannot render: it was configured with GLTFX_BAKE=OFF.");
    return ExitCode::usage;
  }
  permit_unsandboxed_decoders(request.common.unsandboxed_decoders);
  BakeOptions options = request.bake;
  if (const auto problem = check_root(options.root)) {
    complain(problem->message);
    return ExitCode::usage;
  }
  auto schemas = load_schemas(request.schema_files, request.schema_folders);
  if (!schemas) {
    complain(schemas.error().message);
    return ExitCode::usage;
  }
  options.schemas = *std::move(schemas);
  auto cache = open_cache(request.cache, request.quiet);
  if (!cache) {
    complain(cache.error().message);
    return ExitCode::usage;
  }
  options.cache = *std::move(cache);
  return BakeRun(request, std::move(options)).execute();
}

}  // namespace gltfx::tool
