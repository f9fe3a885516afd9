// SPDX-License-Identifier: Apache-2.0
/// Code shared by the verbs that validate: options and the exit code.
#pragma once

#include <gltfx/report.hpp>
#include <gltfx/validate.hpp>

#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/result.hpp"
#include "commands.hpp"
#include "configuration.hpp"
#include "options.hpp"

namespace gltfx::tool {

/// "default", "khronos", "strict".
std::string_view profile_name(Profile profile);

/// The cache in the folder; null without a folder. The key is that of the file, else of the
/// variable GLTFX_CACHE_KEY, else the user's own. The Error is about `--cache`.
Result<std::shared_ptr<ResultCache>> open_cache(const CacheChoice& choice, bool quiet);

/// With the user's schema files read. The Error describes a mistake in one of them, or in the root.
Result<ValidateOptions> validation_of(const ValidateRequest& request);

/// Prints a note if an option has no effect.
void note_useless_options(const ValidateRequest& request);

/// The exit code of a run. `recording`: findings are recorded and not a failure.
ExitCode verdict_on(const RunSummary& summary, const ReportRequest& request,
                    bool recording = false);

/// Options of each path: one object for all paths with the same options.
class OptionsByPath {
 public:
  OptionsByPath(ValidateOptions common, std::shared_ptr<const PathOptions> by_path)
      : common_(std::move(common)), by_path_(std::move(by_path)) {}

  const ValidateOptions& common() const { return common_; }
  /// The reference is valid until the next set_jobs().
  const ValidateOptions& of(const std::string& path);
  void set_jobs(unsigned jobs);
  void set_searched(std::shared_ptr<const SearchedFolders> searched);

 private:
  ValidateOptions common_;
  std::shared_ptr<const PathOptions> by_path_;  ///< null: the same for all paths
  std::map<std::vector<std::size_t>, ValidateOptions> differing_;
};

}  // namespace gltfx::tool
