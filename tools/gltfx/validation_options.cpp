// SPDX-License-Identifier: Apache-2.0
#include "validation_options.hpp"

#include <gltfx/result_cache.hpp>

#include "commands.hpp"
#include "input_paths.hpp"
#include "schema_sources.hpp"

namespace gltfx::tool {

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

Result<std::shared_ptr<ResultCache>> open_cache(const std::string& folder) {
  if (folder.empty()) return std::shared_ptr<ResultCache>();
  std::string problem;
  auto cache = ResultCache::open(folder, problem);
  if (!cache) return Error{"--cache: " + problem};
  return cache;
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
  auto cache = open_cache(request.cache);
  if (!cache) return cache.error();
  options.cache = *std::move(cache);
  return options;
}

void note_useless_options(const ValidateRequest& request) {
  const auto& pixels = request.validation.pixels;
  if (!request.quiet && pixels && *pixels != pixel_level(request.validation)) {
    complain("note: --pixels has no effect with --profile khronos, which reads headers only");
  }
}

ExitCode verdict_on(const RunSummary& summary, const ReportRequest& request, bool recording) {
  ExitCode code = ExitCode::ok;
  if (request.fail_on && summary.counts.at_least(*request.fail_on) > 0 && !recording) {
    code = ExitCode::findings;
  }
  return summary.unreadable > 0 ? worse(code, ExitCode::unreadable) : code;
}

const ValidateOptions& OptionsByPath::of(const std::string& path) {
  if (!by_path_) return common_;
  const std::vector<std::size_t> kind = by_path_->kind_of(path);
  if (kind.empty()) return common_;
  const auto [entry, fresh] = differing_.try_emplace(kind, common_);
  if (fresh) by_path_->apply(kind, entry->second);
  return entry->second;
}

void OptionsByPath::set_jobs(unsigned jobs) {
  common_.jobs = jobs;
  differing_.clear();
}

}  // namespace gltfx::tool
