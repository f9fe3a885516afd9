// SPDX-License-Identifier: Apache-2.0
/// One report in several formats at once, each to its own place.
#pragma once

#include <gltfx/report.hpp>

#include <memory>
#include <string>
#include <vector>

#include "options.hpp"
#include "output.hpp"

namespace gltfx::tool {

/// Calls: begin, file for each report in order, finish. Not thread-safe.
class ReportTargets {
 public:
  explicit ReportTargets(const ValidateRequest& request);

  void begin();
  void file(const FileReport& report);
  void finish(const RunSummary& summary);

  /// What went wrong with the places written to, one sentence a line; empty when all is well.
  std::string problems() const;

 private:
  struct Target {
    Output output;
    std::unique_ptr<ReportWriter> writer;
    std::string pending;  ///< text not yet written
    bool immediate;       ///< somebody watches
  };
  static void flush(Target& target, std::size_t above);

  std::vector<Target> targets_;
};

}  // namespace gltfx::tool
