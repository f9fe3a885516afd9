// SPDX-License-Identifier: Apache-2.0
/// `gltfx convert`, for people, and as JSON for programs.
#pragma once

#include <gltfx/convert.hpp>

#include <cstdint>
#include <string>

#include "terminal.hpp"

namespace gltfx::tool {

/// What the files of a run came to.
struct ConvertSummary {
  std::uint64_t files = 0;       ///< that were read
  std::uint64_t unreadable = 0;  ///< that were not
  std::uint64_t changed = 0;     ///< of the files read; or that would be where nothing is written
  std::uint64_t refused = 0;     ///< of the files read
  std::uint64_t written = 0;     ///< files
  void add(const ConvertReport& report);
};

/// What the steps make of one file. Ends in a line break; empty where there are no steps.
std::string convert_text(const ConvertReport& report, const Style& style);

/// One line on the whole run; `writing`: whether anything was to be written.
std::string convert_summary_text(const ConvertSummary& summary, bool writing);

/// One file; `first`: none was written before it.
std::string convert_json(const ConvertReport& report, bool first);
/// What stands behind the last one, with the numbers of the run.
std::string convert_json_end(const ConvertSummary& summary);

}  // namespace gltfx::tool
