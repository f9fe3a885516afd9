// SPDX-License-Identifier: Apache-2.0
/// The entries of `--format json` and `--format jsonl` for files and runs.
#pragma once

#include <gltfx/report.hpp>

#include <cstdint>

#include "json/writer.hpp"

namespace gltfx::report {

/// Writes `info` as one object: members of the Khronos report, in its order, without empty ones.
void write_asset_info(json::Writer& writer, const AssetInfo& info);

/// One object, as a finding has it.
void write_checked_limit(json::Writer& writer, const CheckedLimit& limit);

/// Raised when a reader of the previous format could misread the next.
inline constexpr std::uint64_t kJsonFormat = 1;

/// `full`: everything that any format needs, so that a report can be read back.
enum class Detail : std::uint8_t { plain, full };

/// `timings`: with the duration.
void write_entry(json::Writer& writer, const FileReport& report, Detail detail,
                 bool timings = false);
void write_summary(json::Writer& writer, const RunSummary& summary);

}  // namespace gltfx::report
