// SPDX-License-Identifier: Apache-2.0
/// Output of `gltfx convert`: for people, and as JSON for programs.
#pragma once

#include <gltfx/convert.hpp>

#include <cstdint>
#include <string>

#include "terminal.hpp"

namespace gltfx::tool {

/// Totals of a run.
struct ConvertSummary {
  std::uint64_t files = 0;       ///< files that were read
  std::uint64_t unreadable = 0;  ///< files that could not be read
  std::uint64_t changed = 0;     ///< read files that changed, or would change if nothing is written
  std::uint64_t refused = 0;     ///< read files with a refusal
  std::uint64_t written = 0;     ///< written files
  void add(const ConvertReport& report);
};

/// The steps of one file. Ends with a line break; empty if there are no steps.
std::string convert_text(const ConvertReport& report, const Style& style);

/// One line about the whole run; `writing`: whether output was requested.
std::string convert_summary_text(const ConvertSummary& summary, bool writing);

/// One file; `first`: it is the first one in the output.
std::string convert_json(const ConvertReport& report, bool first);
/// The text after the last file, with the totals of the run.
std::string convert_json_end(const ConvertSummary& summary);

}  // namespace gltfx::tool
