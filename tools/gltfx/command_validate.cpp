// SPDX-License-Identifier: Apache-2.0
#include <gltfx/pipeline.hpp>
#include <gltfx/result_cache.hpp>

#include <cstdint>
#include <deque>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>

#include "base/text.hpp"
#include "changed_files.hpp"
#include "commands.hpp"
#include "configuration.hpp"
#include "input_paths.hpp"
#include "known_findings.hpp"
#include "progress.hpp"
#include "read_input.hpp"
#include "report_targets.hpp"
#include "schema_sources.hpp"
#include "validate/validator.hpp"

namespace gltfx::tool {
namespace {

// Files that are handed to the threads together: enough to keep them busy, few enough to be small.
constexpr std::size_t kBatch = 1024;

std::string_view profile_name(Profile profile) {
  switch (profile) {
    case Profile::standard:
      return "default";
    case Profile::khronos:
      return "khronos";
    case Profile::strict:
      break;
  }
  return "strict";
}

// A run of inputs through validation, baseline and formats.
class Run {
 public:
  Run(const ValidateRequest& request, ValidateOptions options, KnownFindings known,
      std::optional<ChangedFiles> changed)
      : request_(request),
        options_(std::move(options)),
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
  std::string overwritten_input();
  void check(InputWalk& walk);
  void check_files(const std::vector<Input>& files);
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
  ProgressLine progress_;
  std::uint64_t files_ = 0;  ///< in all, where somebody watches
};

void Run::take(FileReport report) {
  known_.apply(report);
  summary_.add(report);
  targets_.file(report);
  progress_.show(summary_.files, files_);
}

// Goes through the inputs before anything is done, where there is a reason: says so when an output
// would take the place of a file that is to be checked, and counts them for who watches.
std::string Run::overwritten_input() {
  std::vector<std::string> outputs{request_.write_baseline};
  for (const FormatTarget& target : request_.targets) outputs.push_back(target.path);
  std::error_code fault;
  std::erase_if(outputs, [&](const std::string& output) {
    return output.empty() || !std::filesystem::exists(output, fault);
  });
  if (outputs.empty() && !progress_.visible()) return {};
  InputWalk walk(request_.paths);
  while (const auto input = walk.next()) {
    ++files_;
    for (const std::string& output : outputs) {
      if (!std::filesystem::equivalent(output, input->path, fault)) continue;
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

void Run::check_files(const std::vector<Input>& files) {
  // Many files keep all threads busy by themselves.
  options_.jobs = files.size() == 1 ? request_.common.jobs : 1;
  by_path_.clear();
  limited_.clear();
  std::vector<ValidateInput> inputs;
  for (const Input& file : files) {
    inputs.push_back({file.path, &limited(options_for(file.path), file.path)});
  }
  std::size_t next = 0;
  validate_files(inputs, request_.common.jobs, [&](FileReport&& report) {
    look_again(report);
    report.position = files[next++].position;
    take(std::move(report));
  });
}

// Standard input is read where it stands among the paths; what lies between runs in parallel.
void Run::check(InputWalk& walk) {
  std::vector<Input> batch;
  const auto run_batch = [&] {
    check_files(batch);
    batch.clear();
  };
  while (auto input = walk.next()) {
    if (input->path != "-") {
      batch.push_back(*std::move(input));
      if (batch.size() == kBatch) run_batch();
      continue;
    }
    run_batch();
    FileReport report = check_stdin(options_);
    report.position = input->position;
    take(std::move(report));
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
  if (const std::string clash = overwritten_input(); !clash.empty()) {
    complain(clash);
    return ExitCode::usage;
  }
  InputWalk walk(request_.paths);
  targets_.begin();
  check(walk);
  progress_.clear();
  if (!request_.quiet) say_notes(walk);
  summary_.exit_code = static_cast<int>(verdict());
  targets_.finish(summary_);
  std::string problems = targets_.problems();
  if (problems.empty()) problems = known_.write();
  if (problems.empty() && options_.cache) problems = options_.cache->finish();
  if (problems.empty()) return verdict();
  complain(problems);
  return ExitCode::internal;
}

Result<ValidateOptions> validation_of(const ValidateRequest& request) {
  ValidateOptions options = request.validation;
  options.jobs = request.common.jobs;
  for (const FormatTarget& target : request.targets) {
    // Lines hold what any format needs.
    options.propose_fixes = options.propose_fixes || target.format == ReportFormat::sarif ||
                            target.format == ReportFormat::jsonl;
  }
  if (auto problem = check_root(options.root)) return *std::move(problem);
  auto schemas = load_schemas(request.schema_files, request.schema_folders);
  if (!schemas) return schemas.error();
  options.schemas = *std::move(schemas);
  if (request.cache.empty()) return options;
  std::string problem;
  options.cache = ResultCache::open(request.cache, problem);
  if (!options.cache) return Error{"--cache: " + problem};
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
