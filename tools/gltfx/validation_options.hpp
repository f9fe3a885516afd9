// SPDX-License-Identifier: Apache-2.0
/// What the verbs that validate have in common: options, and what a run ends with.
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

/// What an earlier run left in the folder; null without a folder. The key is that of the file, else
/// of the variable GLTFX_CACHE_KEY, else the user's own. The Error is about `--cache`.
Result<std::shared_ptr<ResultCache>> open_cache(const CacheChoice& choice, bool quiet);

/// With the user's schema files read. The Error says what is wrong with one of them, or the root.
Result<ValidateOptions> validation_of(const ValidateRequest& request);

/// A note where an option can do nothing.
void note_useless_options(const ValidateRequest& request);

/// What a run ends with. `recording`: findings are to be known from now on, and no failure.
ExitCode verdict_on(const RunSummary& summary, const ReportRequest& request,
                    bool recording = false);

/// Options of each path: one object for all paths of which the same is asked.
class OptionsByPath {
 public:
  OptionsByPath(ValidateOptions common, std::shared_ptr<const PathOptions> by_path)
      : common_(std::move(common)), by_path_(std::move(by_path)) {}

  const ValidateOptions& common() const { return common_; }
  /// Stays where it is until the next set_jobs().
  const ValidateOptions& of(const std::string& path);
  void set_jobs(unsigned jobs);
  void set_searched(std::shared_ptr<const SearchedFolders> searched);

 private:
  ValidateOptions common_;
  std::shared_ptr<const PathOptions> by_path_;  ///< null: the same for all paths
  std::map<std::vector<std::size_t>, ValidateOptions> differing_;
};

}  // namespace gltfx::tool
