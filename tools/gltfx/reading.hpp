// SPDX-License-Identifier: Apache-2.0
/// From many words to one request.
#pragma once

#include <string>
#include <string_view>
#include <utility>

#include "base/result.hpp"
#include "options.hpp"
#include "words.hpp"

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
  template <class Wanted>
  Result<Wanted> finish(Wanted& request) {
    if (!problem_.empty()) return Error{problem_};
    return std::move(request);
  }

 private:
  std::string problem_;
};

/// `what`: the verb. Whether inputs are named at all is left to the caller.
void read_inputs(Reading& reading, const InputWords& words, std::string_view what,
                 NamedPaths& paths);
/// Refuses "-" among the inputs of a verb that needs files.
void require_files(Reading& reading, const InputWords& words, std::string problem);

void read_common(Reading& reading, const CommonWords& words, CommonOptions& options);

}  // namespace gltfx::tool
