// SPDX-License-Identifier: Apache-2.0
/// One report in several formats at once, each to its own place.
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
  /// `look`: what formats say of the run as a whole.
  struct Look {
    std::string profile, pixel_level;
    Shard shard;
  };
  ReportTargets(const ReportRequest& request, const Look& look);

  /// Called before somebody who watches sees something new.
  void before_output(std::function<void()> call) { before_output_ = std::move(call); }

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
  void flush(Target& target, std::size_t above);

  std::vector<Target> targets_;
  std::function<void()> before_output_;
};

}  // namespace gltfx::tool
