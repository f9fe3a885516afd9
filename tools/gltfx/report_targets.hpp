// SPDX-License-Identifier: Apache-2.0
/// One report in several formats at once, each with its own output.
#pragma once

#include <gltfx/report.hpp>

#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "options.hpp"
#include "output.hpp"

namespace gltfx::tool {

/// Calls: begin, file for each report in order, finish. Not thread-safe.
class ReportTargets {
 public:
  /// `look`: data of formats about the whole run.
  struct Look {
    std::string profile, pixel_level;
    Shard shard;
  };
  ReportTargets(const ReportRequest& request, const Look& look);

  /// Called before new output on a terminal.
  void before_output(std::function<void()> call) { before_output_ = std::move(call); }

  void begin();
  void file(const FileReport& report);
  void finish(const RunSummary& summary);

  /// Failures of outputs, one sentence per line; empty when there is none.
  std::string problems() const;

 private:
  struct Target {
    Output output;
    std::unique_ptr<ReportWriter> writer;
    std::string pending;  ///< text not yet written
    bool immediate;       ///< on a terminal
  };
  void flush(Target& target, std::size_t above);

  std::vector<Target> targets_;
  std::function<void()> before_output_;
};

}  // namespace gltfx::tool
