// SPDX-License-Identifier: Apache-2.0
/// `gltfx edit`, for people, and as JSON for programs.
#pragma once

#include <gltfx/deletion.hpp>

#include <cstdint>
#include <string>

#include "terminal.hpp"

namespace gltfx::tool {

/// What the files of a run came to.
struct DeleteSummary {
  std::uint64_t files = 0;       ///< that were read
  std::uint64_t unreadable = 0;  ///< that were not
  std::uint64_t refused = 0;     ///< of the files read
  std::uint64_t deleted = 0;     ///< values
  std::uint64_t written = 0;     ///< files
  void add(const DeleteReport& report);
};

/// What becomes of one file, or nothing. Ends in a line break.
std::string delete_text(const DeleteReport& report, const Style& style);

/// One line on the whole run; `writing`: whether anything was to be written.
std::string delete_summary_text(const DeleteSummary& summary, bool writing);

/// One file; `first`: none was written before it.
std::string delete_json(const DeleteReport& report, bool first);
/// What stands behind the last one, with the numbers of the run.
std::string delete_json_end(const DeleteSummary& summary);

}  // namespace gltfx::tool
