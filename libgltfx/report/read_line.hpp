// SPDX-License-Identifier: Apache-2.0
/// Reads the output of `--format jsonl`.
#pragma once

#include <gltfx/report.hpp>

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>

#include "base/result.hpp"

namespace gltfx::report {

/// The value in the first line of a run that no finding makes fail.
inline constexpr std::string_view kNever = "never";

/// The first line of a run.
struct RunHead {
  std::string version, profile, pixel_level;
  std::optional<Severity> fail_on = Severity::error;  ///< nothing: never
  Shard shard;
  bool timings = false;  ///< its entries have the duration of each file
};

/// The last line of a run: without it the run was interrupted.
struct RunEnd {};

using ReportLine = std::variant<RunHead, FileReport, RunEnd>;

/// `rules`: those whose codes the report may name, sorted by code, of static storage. The Error
/// describes the mistake in the line.
Result<ReportLine> read_line(std::string_view line, std::span<const RuleDescription> rules);

}  // namespace gltfx::report
