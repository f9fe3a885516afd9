// SPDX-License-Identifier: Apache-2.0
/// Runs the program git without a shell.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.hpp"

namespace gltfx::tool {

/// How git ended and what it wrote to standard output.
struct GitOutcome {
  int code = 0;  ///< exit code; 128 + signal when one ended it
  std::string out;
};

/// Git in one folder. Its standard error is that of this program.
class Git {
 public:
  explicit Git(std::string folder) : folder_(std::move(folder)) {}
  const std::string& folder() const { return folder_; }

  /// Runs `git <arguments>` with `input` as its standard input. Words from a repository or an asset
  /// belong in the input, or after "--". An Error when git cannot be started.
  Result<GitOutcome> run(const std::vector<std::string>& arguments,
                         std::string_view input = {}) const;
  /// The same for large output, which is passed on piece by piece and not kept. Returns the exit
  /// code.
  Result<int> stream(const std::vector<std::string>& arguments, std::string_view input,
                     const std::function<void(std::string_view)>& consume) const;

 private:
  std::string folder_;
};

}  // namespace gltfx::tool
