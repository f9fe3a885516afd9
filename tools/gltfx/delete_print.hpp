// SPDX-License-Identifier: Apache-2.0
/// `gltfx edit`, for people, and as JSON for programs.
#pragma once

#include <gltfx/deletion.hpp>

#include <cstdint>
#include <string>

#include "terminal.hpp"

namespace gltfx::tool {

/// Totals of a run.
struct DeleteSummary {
  std::uint64_t files = 0;       ///< that were read
  std::uint64_t unreadable = 0;  ///< that were not
  std::uint64_t refused = 0;     ///< of the files read
  std::uint64_t deleted = 0;     ///< values
  std::uint64_t written = 0;     ///< files
  void add(const DeleteReport& report);
};

/// The outcome for one file, or an empty text. Ends in a line break.
std::string delete_text(const DeleteReport& report, const Style& style);

/// One line on the whole run; `writing`: whether the run writes files.
std::string delete_summary_text(const DeleteSummary& summary, bool writing);

/// One file; `first`: none was written before it.
std::string delete_json(const DeleteReport& report, bool first);
/// The end of the output, with the totals of the run.
std::string delete_json_end(const DeleteSummary& summary);

}  // namespace gltfx::tool
