// SPDX-License-Identifier: Apache-2.0
/// `gltfx fix`, for people, and as JSON: plans and outcomes for programs.
#pragma once

#include <gltfx/fix.hpp>

#include <cstdint>
#include <string>

#include "terminal.hpp"

namespace gltfx::tool {

/// Totals of a run.
struct FixSummary {
  std::uint64_t files = 0;       ///< that were read
  std::uint64_t unreadable = 0;  ///< that were not
  std::uint64_t fixed = 0;       ///< findings; without writing: those that would be fixed
  std::uint64_t left = 0;        ///< findings with a fix that stay
  std::uint64_t written = 0;     ///< files
  void add(const FixReport& report);
};

/// The fixes of one file, or an empty text when there is nothing to fix. Ends in a line break.
std::string fix_text(const FixReport& report, const Style& style);

/// One line on the whole run; `writing`: whether the run writes files.
std::string fix_summary_text(const FixSummary& summary, bool writing);

/// One file; `first`: none was written before it.
std::string fix_json(const FixReport& report, bool first);
/// The end of the output, with the totals of the run.
std::string fix_json_end(const FixSummary& summary);

}  // namespace gltfx::tool
