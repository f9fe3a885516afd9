// SPDX-License-Identifier: Apache-2.0
#include <gltfx/pipeline.hpp>

#include <deque>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <system_error>
#include <utility>

#include "base/text.hpp"
#include "changed_files.hpp"
#include "commands.hpp"
#include "configuration.hpp"
#include "input_paths.hpp"
#include "known_findings.hpp"
#include "read_input.hpp"
#include "report_targets.hpp"
#include "schema_sources.hpp"
#include "validate/validator.hpp"

namespace gltfx::tool {
namespace {

// A run of inputs through validation, baseline and formats.
class Run {
 public:
  Run(const ValidateRequest& request, ValidateOptions options, KnownFindings known,
      std::optional<ChangedFiles> changed)
      : request_(request),
        options_(std::move(options)),
        known_(std::move(known)),
        changed_(std::move(changed)),
        targets_(request) {}

  ExitCode execute();

 private:
  void check(const std::vector<std::string>& paths);
  void check_files(const std::vector<std::string>& paths);
  const ValidateOptions& options_for(const std::string& path);
  const ValidateOptions& limited(const ValidateOptions& options, const std::string& path);
  void look_again(FileReport& report);
  void take(FileReport report);
  ExitCode verdict() const;

  const ValidateRequest& request_;
  ValidateOptions options_;
  std::map<std::vector<std::size_t>, ValidateOptions> by_path_;  ///< where they differ
  std::deque<ValidateOptions> limited_;                          ///< to lines that changed
  KnownFindings known_;
  std::optional<ChangedFiles> changed_;
  ReportTargets targets_;
  RunSummary summary_;
};

void Run::take(FileReport report) {
  known_.apply(report);
  summary_.add(report);
  targets_.file(report);
}

// Says so when an output would take the place of a file that is to be checked.
std::string overwritten_input(const ValidateRequest& request,
                              const std::vector<std::string>& inputs) {
  std::vector<std::string> outputs{request.write_baseline};
  for (const FormatTarget& target : request.targets) outputs.push_back(target.path);
  for (const std::string& output : outputs) {
    std::error_code fault;
    if (output.empty() || !std::filesystem::exists(output, fault)) continue;
    for (const std::string& input : inputs) {
      if (!std::filesystem::equivalent(output, input, fault)) continue;
      return "the output " + quoted(output, 200) + " is a file that is to be checked";
    }
  }
  return {};
}

FileReport check_stdin(const ValidateOptions& options) {
  auto bytes = read_stdin();
  if (!bytes) return validate::unreadable("-", bytes.error().message, options);
  return validate_bytes(*std::move(bytes), "-", options);
}

const ValidateOptions& Run::options_for(const std::string& path) {
  if (!request_.by_path) return options_;
  const std::vector<std::size_t> kind = request_.by_path->kind_of(path);
  if (kind.empty()) return options_;
  const auto [entry, fresh] = by_path_.try_emplace(kind, options_);
  if (fresh) request_.by_path->apply(kind, entry->second);
  return entry->second;
}

// The options for lines that changed, where not all of the file counts.
const ValidateOptions& Run::limited(const ValidateOptions& options, const std::string& path) {
  auto lines = changed_ ? changed_->lines(path) : std::nullopt;
  if (!lines) return options;
  ValidateOptions& own = limited_.emplace_back(options);
  own.changed_lines = *std::move(lines);
  return own;
}

// Other data, such as a new image, may make wrong what was written long ago.
void Run::look_again(FileReport& report) {
  if (!changed_ || !changed_->companions_changed(report)) return;
  if (changed_->lines(report.path)) report = validate_file(report.path, options_for(report.path));
}

void Run::check_files(const std::vector<std::string>& paths) {
  // Many files keep all threads busy by themselves.
  options_.jobs = paths.size() == 1 ? request_.common.jobs : 1;
  by_path_.clear();
  limited_.clear();
  std::vector<ValidateInput> inputs;
  for (const std::string& path : paths) {
    inputs.push_back({path, &limited(options_for(path), path)});
  }
  validate_files(inputs, request_.common.jobs, [this](FileReport&& report) {
    look_again(report);
    take(std::move(report));
  });
}

// Standard input is read where it stands among the paths; what lies between runs in parallel.
void Run::check(const std::vector<std::string>& paths) {
  std::vector<std::string> batch;
  const auto run_batch = [&] {
    check_files(batch);
    batch.clear();
  };
  for (const std::string& path : paths) {
    if (path != "-") {
      batch.push_back(path);
      continue;
    }
    run_batch();
    take(check_stdin(options_));
  }
  run_batch();
}

ExitCode Run::verdict() const {
  ExitCode code = ExitCode::ok;
  if (request_.fail_on && summary_.counts.at_least(*request_.fail_on) > 0 && !known_.recording()) {
    code = ExitCode::findings;
  }
  return summary_.unreadable > 0 ? worse(code, ExitCode::unreadable) : code;
}

ExitCode Run::execute() {
  if (const std::string problems = targets_.problems(); !problems.empty()) {
    complain(problems);
    return ExitCode::internal;
  }
  const auto& pixels = request_.validation.pixels;
  if (!request_.quiet && pixels && *pixels != pixel_level(request_.validation)) {
    complain("note: --pixels has no effect with --profile khronos, which reads headers only");
  }
  const Inputs inputs = expand_paths(request_.paths, request_.quiet);
  if (const std::string clash = overwritten_input(request_, inputs.paths); !clash.empty()) {
    complain(clash);
    return ExitCode::usage;
  }
  targets_.begin();
  check(inputs.paths);
  summary_.exit_code = static_cast<int>(verdict());
  targets_.finish(summary_);
  std::string problems = targets_.problems();
  if (problems.empty()) problems = known_.write();
  if (problems.empty()) return verdict();
  complain(problems);
  return ExitCode::internal;
}

Result<ValidateOptions> validation_of(const ValidateRequest& request) {
  ValidateOptions options = request.validation;
  options.jobs = request.common.jobs;
  for (const FormatTarget& target : request.targets) {
    if (target.format == ReportFormat::sarif) options.propose_fixes = true;
  }
  if (auto problem = check_root(options.root)) return *std::move(problem);
  auto schemas = load_schemas(request.schema_files, request.schema_folders);
  if (!schemas) return schemas.error();
  options.schemas = *std::move(schemas);
  return options;
}

}  // namespace

ExitCode run(const ValidateRequest& request) {
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
