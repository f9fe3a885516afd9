// SPDX-License-Identifier: Apache-2.0
#include "report/text_summary.hpp"

#include <array>

#include <fmt/format.h>

#include "report/rule_lookup.hpp"
#include "report/safe_text.hpp"
#include "report/style.hpp"
#include "report/wording.hpp"

namespace gltfx::report {
namespace {

constexpr std::array kSeverities{Severity::error, Severity::warning, Severity::info,
                                 Severity::hint};

// "1 error, 3 warnings", from `first` to `last`, without those of which there are none.
std::string tally(const Counts& counts, Severity first, Severity last, const Style& style) {
  std::string text;
  for (const Severity severity : kSeverities) {
    const std::uint64_t count = count_of(counts, severity);
    if (severity < first || severity > last || count == 0) continue;
    if (!text.empty()) text += ", ";
    text += style.paint(ink_of(severity), counted(count, severity_name(severity)));
  }
  return text;
}

// "4 infos and hints", of which the listing has none.
std::string unlisted_note(const RunSummary& summary, const FormatOptions& options) {
  const auto below = static_cast<Severity>(static_cast<int>(options.min_severity) + 1);
  const std::string text = tally(summary.counts, below, Severity::hint, Style(false));
  if (text.empty()) return {};
  return fmt::format("not listed: {} (--min-severity {} lists them)\n", text,
                     severity_name(summary.counts.hints > 0 ? Severity::hint : Severity::info));
}

}  // namespace

std::string rule_label(const Style& style, Severity severity, std::string_view code) {
  return style.paint(ink_of(severity), fmt::format("{}[{}]", severity_name(severity), safe(code)));
}

std::string_view rule_summary(std::span<const RuleDescription> rules, std::string_view code) {
  const RuleDescription* rule = find_rule_in(rules, code);
  return rule == nullptr ? std::string_view() : rule->summary;
}

std::uint64_t count_of(const Counts& counts, Severity severity) {
  if (severity == Severity::error) return counts.errors;
  if (severity == Severity::warning) return counts.warnings;
  return severity == Severity::info ? counts.infos : counts.hints;
}

std::string text_summary(const RunSummary& summary, const FormatOptions& options) {
  const Style style(options.color);
  std::string found = tally(summary.counts, Severity::error, Severity::hint, style);
  if (found.empty()) {
    found = style.paint(
        Ink::good, summary.suppressed + summary.unchanged > 0 ? "no new problems" : "no problems");
  }
  std::string out = counted(summary.files, "file") + " checked: " + found + "\n";
  const auto add = [&](const std::string& note) {
    if (!note.empty()) out += note + "\n";
  };
  out += unlisted_note(summary, options);
  add(pixels_note(summary, options.pixel_level));
  if (summary.unreadable > 0) add(counted(summary.unreadable, "file") + " could not be read");
  if (summary.unverified > 0) add(unverified_note(summary.unverified));
  if (summary.suppressed > 0) {
    add(counted(summary.suppressed, "finding") + " known to the baseline");
  }
  if (summary.left_out > 0) add(left_out_note(summary.left_out));
  if (summary.unchanged > 0) add(unchanged_note(summary.unchanged));
  if (summary.counts.at_least(Severity::hint) > 0) {
    add(fmt::format("`{} explain CODE` tells more about a finding",
                    options.command.empty() ? "gltfx" : safe(options.command)));
  }
  return out;
}

}  // namespace gltfx::report
