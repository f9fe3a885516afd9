// SPDX-License-Identifier: Apache-2.0
/// `gltfx upgrade`, for people, and as JSON: plans and outcomes for programs.
#pragma once

#include <gltfx/upgrade.hpp>

#include <cstdint>
#include <set>
#include <string>

#include "terminal.hpp"

namespace gltfx::tool {

/// Totals of a run.
struct UpgradeSummary {
  std::uint64_t files = 0;           ///< that were read
  std::uint64_t unreadable = 0;      ///< that were not
  std::uint64_t objects = 0;         ///< requested legacy objects
  std::uint64_t others = 0;          ///< those on request, or without a successor
  std::uint64_t done = 0;            ///< of `objects`: upgraded, or those that would be
  std::uint64_t written = 0;         ///< files
  std::set<std::string> on_request;  ///< why objects are upgraded on request only, and the options
  void add(const UpgradeReport& report);
};

/// The plan of one file, or an empty text when it has no legacy objects. Ends in a line break.
std::string upgrade_plan_text(const UpgradeReport& report, const Style& style);

/// One line on the whole run, and the upgrades on request; `writing`: whether the run writes files.
std::string upgrade_summary_text(const UpgradeSummary& summary, bool writing);

/// One file; `first`: none was written before it.
std::string upgrade_json(const UpgradeReport& report, bool first);
/// The end of the output, with the totals of the run.
std::string upgrade_json_end(const UpgradeSummary& summary);

}  // namespace gltfx::tool
