// SPDX-License-Identifier: Apache-2.0
/// Reads back what `--format jsonl` wrote.
#pragma once

#include <gltfx/report.hpp>

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>

#include "base/result.hpp"

namespace gltfx::report {

/// As the first line names a run that nothing makes fail.
inline constexpr std::string_view kNever = "never";

/// The first line of a run.
struct RunHead {
  std::string version, profile, pixel_level;
  std::optional<Severity> fail_on = Severity::error;  ///< nothing: never
  Shard shard;
  bool timings = false;  ///< its entries say how long each file took
};

/// Its last line: without it the run was cut off.
struct RunEnd {};

using ReportLine = std::variant<RunHead, FileReport, RunEnd>;

/// `rules`: those whose codes the report may name, sorted by code, of static storage. An Error says
/// what is wrong with the line.
Result<ReportLine> read_line(std::string_view line, std::span<const RuleDescription> rules);

}  // namespace gltfx::report
