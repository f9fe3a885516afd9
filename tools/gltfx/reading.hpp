// SPDX-License-Identifier: Apache-2.0
/// Reads the words of a verb into a request.
#pragma once

#include <string>
#include <string_view>
#include <utility>

#include "option_rows.hpp"

namespace gltfx::tool {

/// Reads the words of a verb and records the first mistake.
class Reading {
 public:
  explicit Reading(const Options& options) : options_(options) {}

  void require(bool holds, std::string problem) {
    if (!holds && problem_.empty()) problem_ = std::move(problem);
  }
  /// Reads the words into the request.
  void read() {
    if (!problem_.empty()) return;
    if (const auto mistake = options_.read()) problem_ = mistake->message;
  }
  /// Requires inputs, named in one way; standard input is either a list or an asset. With a hook,
  /// the commit names them.
  void require_inputs(std::string_view verb);
  /// Refuses "-" among the paths of a verb that needs files. `done`: what the verb does with files
  /// beside the asset.
  void require_files(std::string_view verb, std::string_view done = "found");
  /// --statistics, --cache-key.
  void require_companions();

  const Options& options() const { return options_; }
  /// The first mistake, or empty.
  const std::string& problem() const { return problem_; }

 private:
  const Options& options_;
  std::string problem_;
};

}  // namespace gltfx::tool
