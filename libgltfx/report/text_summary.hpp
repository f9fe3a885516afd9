// SPDX-License-Identifier: Apache-2.0
/// What all layouts of the text format end with.
#pragma once

#include <gltfx/report.hpp>

#include <span>
#include <string>
#include <string_view>

#include "report/style.hpp"

namespace gltfx::report {

/// "3 files checked: 1 error, 4 infos", and a line for each thing that was left out. Ends with a
/// line break.
std::string text_summary(const RunSummary& summary, const FormatOptions& options);

/// "error[NODE_LOOP]", as each finding and each group of them begins.
std::string rule_label(const Style& style, Severity severity, std::string_view code);

/// What the rule says in a line; empty when it is not among `rules`.
std::string_view rule_summary(std::span<const RuleDescription> rules, std::string_view code);

/// Findings of that severity.
std::uint64_t count_of(const Counts& counts, Severity severity);

}  // namespace gltfx::report
