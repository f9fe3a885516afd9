// SPDX-License-Identifier: Apache-2.0
/// The program git, asked without a shell.
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

/// Git in one folder. What it says on standard error goes where ours does.
class Git {
 public:
  explicit Git(std::string folder) : folder_(std::move(folder)) {}
  const std::string& folder() const { return folder_; }

  /// Runs `git <arguments>` with `input` as its standard input. Words from a repository or an asset
  /// belong into the input, or behind "--". An Error when git cannot be started.
  Result<GitOutcome> run(const std::vector<std::string>& arguments,
                         std::string_view input = {}) const;
  /// The same for much output: handed over piece by piece, not kept. Gives the exit code.
  Result<int> stream(const std::vector<std::string>& arguments, std::string_view input,
                     const std::function<void(std::string_view)>& consume) const;

 private:
  std::string folder_;
};

}  // namespace gltfx::tool
