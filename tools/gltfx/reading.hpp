// SPDX-License-Identifier: Apache-2.0
/// From many words to one request.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/result.hpp"
#include "options.hpp"
#include "raw_options.hpp"

namespace gltfx::tool {

/// Collects values and keeps the first thing that was wrong.
class Reading {
 public:
  template <class T>
  void set(T& value, Result<T> read) {
    if (!problem_.empty()) return;
    if (read) {
      value = *std::move(read);
    } else {
      problem_ = read.error().message;
    }
  }
  void require(bool holds, std::string problem) {
    if (!holds && problem_.empty()) problem_ = std::move(problem);
  }
  /// The first thing that was wrong, or empty.
  const std::string& problem() const { return problem_; }
  template <class Wanted>
  Result<Wanted> finish(Wanted& request) {
    if (!problem_.empty()) return Error{problem_};
    return std::move(request);
  }

 private:
  std::string problem_;
};

/// `what`: the verb. Whether inputs are named at all is left to the caller.
void read_inputs(Reading& reading, const RawInputOptions& words, std::string_view what,
                 NamedPaths& paths);
/// Refuses "-" among the paths of a verb that needs files. `what`: as above; `done`: what is done
/// with those beside the asset.
void require_files(Reading& reading, const std::vector<std::string>& paths, std::string_view what,
                   std::string_view done = "found");

void read_common(Reading& reading, const RawCommonOptions& words, CommonOptions& options);

}  // namespace gltfx::tool
