// SPDX-License-Identifier: Apache-2.0
/// `--baseline FILE` and `--write-baseline FILE`.
#pragma once

#include <gltfx/report.hpp>

#include <optional>
#include <string>

#include "base/result.hpp"
#include "report/baseline.hpp"

namespace gltfx::tool {

/// Known findings, and findings to record. Not thread-safe.
class KnownFindings {
 public:
  /// Empty names: nothing is read, nothing is recorded. A missing file counts as empty if a
  /// baseline is recorded. `max_issues` is counted after known findings were removed, so that they
  /// do not use up the limit.
  static Result<KnownFindings> load(const std::string& file, const std::string& record_to,
                                    std::uint64_t max_issues);

  /// Whether anything is read or recorded: then validation itself must not limit its findings.
  bool active() const { return baseline_.has_value() || recording(); }
  bool recording() const { return !record_to_.empty(); }

  /// Records the report's findings, then removes the known ones and applies the limit.
  void apply(FileReport& report);

  /// Writes the recorded findings. Returns a sentence about a failure, or an empty text.
  std::string write() const;
  /// A note on what was written where. Precondition: recording().
  std::string note() const;

 private:
  void record(const FileReport& report);

  std::optional<report::Baseline> baseline_;
  std::string record_to_;
  std::uint64_t max_issues_ = 0;
  report::BaselineWriter recorded_;
  std::uint64_t findings_ = 0, files_ = 0;  ///< that were recorded
};

}  // namespace gltfx::tool
