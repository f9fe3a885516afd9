// SPDX-License-Identifier: Apache-2.0
/// `--baseline FILE` and `--write-baseline FILE`.
#pragma once

#include <gltfx/report.hpp>

#include <optional>
#include <string>

#include "base/result.hpp"
#include "report/baseline.hpp"

namespace gltfx::tool {

/// Findings that are known, and those to be known from now on. Not thread-safe.
class KnownFindings {
 public:
  /// Empty names: nothing is read, nothing is recorded. A file that is not there yet knows nothing,
  /// as long as one is recorded. `max_issues` is counted after known
  /// findings were left out, so that they do not use up the limit.
  static Result<KnownFindings> load(const std::string& file, const std::string& record_to,
                                    std::uint64_t max_issues);

  /// Whether anything is read or recorded: then validation itself must not limit its findings.
  bool active() const { return baseline_.has_value() || recording(); }
  bool recording() const { return !record_to_.empty(); }

  /// Records the report's findings, then takes the known ones out and keeps to the limit.
  void apply(FileReport& report);

  /// Writes what was recorded; a sentence about what went wrong, or empty.
  std::string write() const;
  /// What was written where, as a note. Precondition: recording().
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
