// SPDX-License-Identifier: Apache-2.0
// For coding agents and grep: everything about a finding in one line.
//
//     SEVERITY[CODE] PLACE at POINTER ('NAME'): MESSAGE | help: HELP | fix: TOOL | note: REPEATS
//     summary: 3 files, 1 error; profile default, pixels headers
//
// PLACE is PATH:LINE:COLUMN, or PATH alone; unknown parts after ':' are left out. No line begins
// with asset text.
#include <string>

#include <fmt/format.h>

#include "report/rule_lookup.hpp"
#include "report/safe_text.hpp"
#include "report/wording.hpp"
#include "report/writers.hpp"

namespace gltfx::report {
namespace {

std::string tally(const Counts& counts) {
  std::string text;
  const auto add = [&](std::uint64_t count, std::string_view noun) {
    if (count > 0) text += ", " + counted(count, noun);
  };
  add(counts.errors, "error");
  add(counts.warnings, "warning");
  add(counts.infos, "info");
  add(counts.hints, "hint");
  return text.empty() ? ", no problems" : text;
}

class AgentWriter final : public ReportWriter {
 public:
  explicit AgentWriter(const FormatOptions& options) : options_(options) {}

  void begin(std::string&) override {}

  void file(const FileReport& report, std::string& out) override {
    for (const Diagnostic& finding : report.diagnostics) {
      out +=
          fmt::format("{}[{}] {}{}: {}", severity_name(finding.severity), safe(finding.code),
                      file_place(report, finding), document_place(finding), safe(finding.message));
      remark("help", help_for(finding), out);
      if (finding.fixable) remark("fix", "gltfx fix does this", out);
      remark("note", repeat_note(finding), out);
      out += '\n';
    }
    if (!report.truncated) return;
    out += fmt::format("note: {}: {}\n", safe(report.path), truncation_note(report));
  }

  void end(const RunSummary& summary, std::string& out) override {
    if (options_.quiet) return;
    out += fmt::format("summary: {}{}", counted(summary.files, "file"), tally(summary.counts));
    if (summary.unreadable > 0) {
      out += fmt::format("; {} could not be read", counted(summary.unreadable, "file"));
    }
    if (summary.fixable > 0) out += "; " + fixable_note(summary, options_.profile);
    if (summary.unverified > 0) out += "; " + unverified_note(summary.unverified);
    if (summary.images_decoded < summary.images_wanted) {
      out += "; " + pixels_note(summary, options_.pixel_level);
    }
    if (summary.suppressed > 0) {
      out += fmt::format("; {} known to the baseline", counted(summary.suppressed, "finding"));
    }
    if (summary.left_out > 0) out += "; " + left_out_note(summary.left_out);
    if (summary.unchanged > 0) out += "; " + unchanged_note(summary.unchanged);
    out += fmt::format("; profile {}, pixels {}\n", options_.profile, options_.pixel_level);
  }

 private:
  // The help of the rule, if the finding has none.
  std::string help_for(const Diagnostic& finding) const {
    if (!finding.help.empty()) return safe(finding.help);
    const RuleDescription* rule = find_rule_in(options_.rules, finding.code);
    return rule != nullptr ? std::string(rule->help) : std::string();
  }

  static void remark(std::string_view label, std::string_view text, std::string& out) {
    if (!text.empty()) out += fmt::format(" | {}: {}", label, text);
  }

  FormatOptions options_;
};

}  // namespace

std::unique_ptr<ReportWriter> make_agent_writer(const FormatOptions& options) {
  return std::make_unique<AgentWriter>(options);
}

}  // namespace gltfx::report
