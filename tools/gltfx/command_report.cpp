// SPDX-License-Identifier: Apache-2.0
#include <gltfx/decoders.hpp>
#include <gltfx/pipeline.hpp>
#include <gltfx/result_cache.hpp>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "base/text.hpp"
#include "commands.hpp"
#include "input_paths.hpp"
#include "known_findings.hpp"
#include "output.hpp"
#include "progress.hpp"
#include "read_input.hpp"
#include "report/read_line.hpp"
#include "report/wording.hpp"
#include "validation_options.hpp"

namespace gltfx::tool {
namespace {

constexpr std::uint64_t kManyAssets = 200;  // above which pictures are drafts by default

PageOptions page_options(const PageRequest& request) {
  const ValidateRequest& validate = request.validate;
  PageOptions options;
  options.title = request.title.empty() ? fmt::format("{}", fmt::join(validate.paths.words, ", "))
                                        : request.title;
  if (options.title.empty()) options.title = "Assets";
  options.profile = profile_name(validate.validation.profile);
  options.pixel_level = pixel_level_name(pixel_level(validate.validation));
  options.rules = rules(validate.own_rules.get());
  options.shard = validate.paths.shard;
  options.fail_on = validate.fail_on;
  return options;
}

Result<report::RequirementsByPath> previous_requirements(const std::string& file) {
  if (file.empty()) return report::RequirementsByPath();
  const auto text = read_text_file(file, kLongestAsset);
  if (!text) return Error{"--previous: " + text.error().message};
  auto requirements = report::read_requirements(*text);
  if (!requirements) {
    return Error{
        fmt::format("--previous: {}: {}", quoted(file, 200), requirements.error().message)};
  }
  return requirements;
}

/// A run of inputs for one page.
class ReportRun {
 public:
  ReportRun(const PageRequest& request, ValidateOptions options, KnownFindings known,
            report::RequirementsByPath previous)
      : request_(request),
        options_(std::move(options), request.validate.by_path),
        known_(std::move(known)),
        previous_(std::move(previous)),
        thumbnails_(request.thumbnails),
        page_(page_options(request)),
        output_(request.output, true),
        progress_(!request.validate.quiet, true) {}

  ExitCode execute() {
    if (!output_.problem().empty()) {
      complain(output_.problem());
      return ExitCode::internal;
    }
    const ValidateRequest& validate = request_.validate;
    if (const auto problem = nothing_found(validate.paths)) {
      complain(problem->message);
      return ExitCode::usage;
    }
    note_useless_options(validate);
    const bool choose = thumbnails_.draw && !thumbnails_.quality;
    const auto found = look_ahead(validate.paths, {request_.output}, progress_.visible() || choose);
    if (!found) {
      complain(found.error().message);
      return ExitCode::usage;
    }
    files_ = *found;
    if (choose && files_of_all_shards() > kManyAssets) thumbnails_.quality = BakeQuality::draft;
    InputWalk walk(validate.paths);
    options_.set_searched(walk.searched());
    page_.begin(text_);
    collect(walk);
    if (!validate.quiet) say_notes(walk);
    page_.end(summary_, text_);
    flush(0);
    output_.finish();
    progress_.clear();
    std::string problem = output_.problem();
    const auto& cache = options_.common().cache;
    if (problem.empty() && cache) problem = cache->finish();
    if (!problem.empty()) {
      complain(problem);
      return ExitCode::internal;
    }
    tell();
    return verdict_on(summary_, request_.validate);
  }

 private:
  // The pictures of all parts have the same quality.
  std::uint64_t files_of_all_shards() const {
    NamedPaths all = request_.validate.paths;
    if (all.shard.count == 1) return files_;
    all.shard = {};
    const auto found = look_ahead(all, {}, true);
    return found ? *found : files_;
  }

  void collect(InputWalk& walk) {
    std::vector<Input> batch;
    while (auto input = walk.next()) {
      batch.push_back(*std::move(input));
      if (batch.size() < kBatch) continue;
      collect(batch);
      batch.clear();
    }
    collect(batch);
  }

  void collect(const std::vector<Input>& files) {
    const unsigned jobs = request_.validate.common.jobs;
    options_.set_jobs(files.size() == 1 ? jobs : 1);
    std::vector<ValidateInput> inputs;
    for (const Input& file : files) inputs.push_back({file.path, &options_.of(file.path)});
    std::size_t next = 0;
    report_files(inputs, thumbnails_, jobs, [&](PageAsset&& asset) {
      asset.report.position = files[next++].position;
      take(asset);
    });
  }

  void take(PageAsset& asset) {
    known_.apply(asset.report);
    for (FileReport& external : asset.report.external_assets) {
      external.path = std::filesystem::path(external.path).lexically_normal().native();
      known_.apply(external);
    }
    const auto previous = previous_.find(asset.report.path);
    if (previous != previous_.end()) asset.previous = previous->second;
    summary_.add(asset.report);
    page_.asset(asset, text_);
    flush(kOutputBuffer);
    progress_.show(summary_.files, files_);
  }

  void flush(std::size_t above) {
    if (text_.size() <= above) return;
    output_.write(text_);
    text_.clear();
  }

  void tell() const {
    if (request_.validate.quiet || request_.output.empty()) return;
    using report::counted;
    static_cast<void>(print(fmt::format(
        "{}: {}, {}, {}\n", printable(request_.output), counted(summary_.files, "asset"),
        counted(summary_.counts.errors, "error"), counted(summary_.counts.warnings, "warning"))));
  }

  const PageRequest& request_;
  OptionsByPath options_;
  KnownFindings known_;
  report::RequirementsByPath previous_;
  ThumbnailOptions thumbnails_;
  PageWriter page_;
  Output output_;
  ProgressLine progress_;
  RunSummary summary_;
  std::string text_;
  std::uint64_t files_ = 0;  ///< in total, if progress is shown
};

}  // namespace

ExitCode run(const PageRequest& request) {
  permit_unsandboxed_decoders(request.validate.common.unsandboxed_decoders);
  auto options = validation_of(request.validate);
  if (!options) {
    complain(options.error().message);
    return ExitCode::usage;
  }
  auto known = KnownFindings::load(request.validate.baseline, {}, options->max_issues);
  if (!known) {
    complain(known.error().message);
    return ExitCode::usage;
  }
  if (known->active()) options->max_issues = 0;
  auto previous = previous_requirements(request.previous);
  if (!previous) {
    complain(previous.error().message);
    return ExitCode::usage;
  }
  return ReportRun(request, *std::move(options), *std::move(known), *std::move(previous)).execute();
}

}  // namespace gltfx::tool
