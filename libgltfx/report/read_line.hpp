// SPDX-License-Identifier: Apache-2.0
/// Reads the output of `--format jsonl`, and requirements of that of `--format json`.
#pragma once

#include <gltfx/report.hpp>

#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

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

/// `rules`: sorted by code, of static storage. Other codes are those of own rules. The Error
/// describes the mistake in the line.
Result<ReportLine> read_line(std::string_view line, std::span<const RuleDescription> rules);

/// The requirements of the files of a report, by path.
using RequirementsByPath = std::map<std::string, std::vector<Requirement>, std::less<>>;

/// `text`: output of --format json. The Error describes the mistake in it.
Result<RequirementsByPath> read_requirements(std::string_view text);

}  // namespace gltfx::report
