// SPDX-License-Identifier: Apache-2.0
#include <gltfx/decoders.hpp>
#include <gltfx/pipeline.hpp>
#include <gltfx/result_cache.hpp>

#include <algorithm>
#include <cstdint>
#include <deque>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "changed_files.hpp"
#include "commands.hpp"
#include "external_reports.hpp"
#include "input_paths.hpp"
#include "known_findings.hpp"
#include "progress.hpp"
#include "read_input.hpp"
#include "report_targets.hpp"
#include "rules/validator.hpp"
#include "validation_options.hpp"

namespace gltfx::tool {
namespace {

// A run of inputs through validation, baseline and formats.
class Run {
 public:
  Run(const ValidateRequest& request, ValidateOptions options, KnownFindings known,
      std::optional<ChangedFiles> changed)
      : request_(request),
        options_(std::move(options), request.by_path),
        known_(std::move(known)),
        changed_(std::move(changed)),
        targets_(request, {std::string(profile_name(request.validation.profile)),
                           std::string(pixel_level_name(pixel_level(request.validation))),
                           request.paths.shard}),
        progress_(!request.quiet) {
    targets_.before_output([this] { progress_.clear(); });
  }

  ExitCode execute();

 private:
  void check(InputWalk& walk);
  void check_files(const std::vector<Input>& files);
  const ValidateOptions& limited(const ValidateOptions& options, const std::string& path);
  void look_again(FileReport& report);
  bool companions_changed(const FileReport& report) const;
  void take(FileReport report);
  ExitCode verdict() const;

  const ValidateRequest& request_;
  OptionsByPath options_;
  std::deque<ValidateOptions> limited_;  ///< to changed lines
  KnownFindings known_;
  std::optional<ChangedFiles> changed_;
  ExternalReports external_;
  ReportTargets targets_;
  RunSummary summary_;
  ProgressLine progress_;
  std::uint64_t files_ = 0;  ///< in total, if progress is shown
};

void Run::take(FileReport report) {
  known_.apply(report);
  summary_.add(report);
  targets_.file(report);
  progress_.show(summary_.files, files_);
}

FileReport check_stdin(const ValidateOptions& options) {
  auto bytes = read_stdin(kLongestAsset);
  if (!bytes) return validate::unreadable("-", bytes.error().message, options);
  return validate_bytes(*std::move(bytes), "-", options);
}

// The options for changed lines, unless the whole file counts.
const ValidateOptions& Run::limited(const ValidateOptions& options, const std::string& path) {
  if (!changed_) return options;
  ValidateOptions& own = limited_.emplace_back(options);
  own.changed_lines = changed_->lines(path);
  own.changed_lines_of = [this](const std::string& external) { return changed_->lines(external); };
  return own;
}

bool Run::companions_changed(const FileReport& report) const {
  return changed_->companions_changed(report) ||
         std::any_of(report.external_assets.begin(), report.external_assets.end(),
                     [&](const FileReport& one) { return changed_->companions_changed(one); });
}

// Changed data, such as a new image, can cause findings on unchanged lines.
void Run::look_again(FileReport& report) {
  if (!changed_ || !companions_changed(report)) return;
  std::set<std::string> whole;
  for (const FileReport& external : report.external_assets) {
    if (changed_->companions_changed(external)) whole.insert(external.path);
  }
  if (whole.empty() && !changed_->lines(report.path)) return;
  ValidateOptions options = options_.of(report.path);
  options.changed_lines_of = [&](const std::string& path) {
    return whole.count(path) > 0 ? std::nullopt : changed_->lines(path);
  };
  report = validate_file(report.path, options);
}

void Run::check_files(const std::vector<Input>& files) {
  // Several files keep all threads busy.
  options_.set_jobs(files.size() == 1 ? request_.common.jobs : 1);
  limited_.clear();
  std::vector<ValidateInput> inputs;
  for (const Input& file : files) {
    inputs.push_back({file.path, &limited(options_.of(file.path), file.path)});
  }
  std::size_t next = 0;
  validate_files(inputs, request_.common.jobs, [&](FileReport&& report) {
    look_again(report);
    report.position = files[next++].position;
    external_.take_from(report);
    take(std::move(report));
  });
}

// Standard input is read at its position among the paths; the files between run in parallel.
void Run::check(InputWalk& walk) {
  std::vector<Input> batch;
  const auto run_batch = [&] {
    check_files(batch);
    batch.clear();
  };
  while (auto input = walk.next_of_all()) {
    external_.name(input->path);
    if (!input->ours) continue;
    if (input->path != "-") {
      batch.push_back(*std::move(input));
      if (batch.size() == kBatch) run_batch();
      continue;
    }
    run_batch();
    FileReport report = check_stdin(options_.common());
    report.position = input->position;
    external_.take_from(report);
    take(std::move(report));
  }
  run_batch();
  for (FileReport& report : external_.take()) take(std::move(report));
}

ExitCode Run::verdict() const { return verdict_on(summary_, request_, known_.recording()); }

ExitCode Run::execute() {
  if (const std::string problems = targets_.problems(); !problems.empty()) {
    complain(problems);
    return ExitCode::internal;
  }
  if (const auto problem = nothing_found(request_.paths)) {
    complain(problem->message);
    return ExitCode::usage;
  }
  note_useless_options(request_);
  std::vector<std::string> outputs{request_.write_baseline};
  for (const FormatTarget& target : request_.targets) outputs.push_back(target.path);
  const auto found = look_ahead(request_.paths, std::move(outputs), progress_.visible());
  if (!found) {
    complain(found.error().message);
    return ExitCode::usage;
  }
  files_ = *found;
  InputWalk walk(request_.paths);
  options_.set_searched(walk.searched());
  targets_.begin();
  check(walk);
  progress_.clear();
  if (!request_.quiet) say_notes(walk);
  summary_.exit_code = static_cast<int>(verdict());
  targets_.finish(summary_);
  std::string problems = targets_.problems();
  if (problems.empty()) problems = known_.write();
  if (problems.empty() && known_.recording() && !request_.quiet) complain(known_.note());
  if (problems.empty() && options_.common().cache) problems = options_.common().cache->finish();
  if (problems.empty()) return verdict();
  complain(problems);
  return ExitCode::internal;
}

}  // namespace

ExitCode run(const ValidateRequest& request) {
  permit_unsandboxed_decoders(request.common.unsandboxed_decoders);
  auto options = validation_of(request);
  if (!options) {
    complain(options.error().message);
    return ExitCode::usage;
  }
  auto known = KnownFindings::load(request.baseline, request.write_baseline, options->max_issues);
  if (!known) {
    complain(known.error().message);
    return ExitCode::usage;
  }
  if (known->active()) options->max_issues = 0;
  std::optional<ChangedFiles> changed;
  if (!request.diff_base.empty()) {
    auto since = ChangedFiles::since(request.diff_base);
    if (!since) {
      complain(since.error().message);
      return ExitCode::usage;
    }
    changed = *std::move(since);
  }
  return Run(request, *std::move(options), *std::move(known), std::move(changed)).execute();
}

}  // namespace gltfx::tool
