// SPDX-License-Identifier: Apache-2.0
/// `gltfx upgrade`, for people, and as JSON: plans and outcomes for programs.
#pragma once

#include <gltfx/upgrade.hpp>

#include <cstdint>
#include <set>
#include <string>

#include "terminal.hpp"

namespace gltfx::tool {

/// What the files of a run came to.
struct UpgradeSummary {
  std::uint64_t files = 0;       ///< that were read
  std::uint64_t unreadable = 0;  ///< that were not
  std::uint64_t objects = 0;     ///< legacy ones that the run is about
  std::uint64_t others = 0;      ///< those on request, or without a successor
  std::uint64_t done = 0;        ///< of these: upgraded, or to be upgraded when nothing is written
  std::uint64_t written = 0;     ///< files
  std::set<std::string> on_request;  ///< why objects are upgraded on request only, and how to ask
  void add(const UpgradeReport& report);
};

/// The plan of one file, or nothing when there is nothing legacy in it. Ends in a line break.
std::string upgrade_plan_text(const UpgradeReport& report, const Style& style);

/// One line on the whole run, and what was left for a request; `writing`: whether anything was to
/// be written.
std::string upgrade_summary_text(const UpgradeSummary& summary, bool writing);

/// What stands before the first file.
std::string upgrade_json_begin();
/// One file; `first`: none was written before it.
std::string upgrade_json(const UpgradeReport& report, bool first);
/// What stands behind the last one, with the numbers of the run.
std::string upgrade_json_end(const UpgradeSummary& summary);

}  // namespace gltfx::tool
