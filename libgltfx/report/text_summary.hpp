// SPDX-License-Identifier: Apache-2.0
/// What all layouts of the text format end with.
#pragma once

#include <gltfx/report.hpp>

#include <string>

namespace gltfx::report {

/// "3 files checked: 1 error, 4 infos", and a line for each thing that was left out. Ends with a
/// line break.
std::string text_summary(const RunSummary& summary, const FormatOptions& options);

/// Findings of that severity.
std::uint64_t count_of(const Counts& counts, Severity severity);

}  // namespace gltfx::report
