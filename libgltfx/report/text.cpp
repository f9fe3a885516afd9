// SPDX-License-Identifier: Apache-2.0
// For people: a block a finding, as compilers print it, and a summary at the end.
#include <string>
#include <vector>

#include <fmt/format.h>

#include "report/excerpt.hpp"
#include "report/safe_text.hpp"
#include "report/style.hpp"
#include "report/wording.hpp"
#include "report/writers.hpp"

namespace gltfx::report {
namespace {

class TextWriter final : public ReportWriter {
 public:
  explicit TextWriter(const FormatOptions& options)
      : style_(options.color),
        quiet_(options.quiet),
        command_(options.command.empty() ? "gltfx" : options.command),
        pixel_level_(options.pixel_level) {}

  void begin(std::string&) override {}

  void file(const FileReport& report, std::string& out) override {
    for (const Diagnostic& diagnostic : report.diagnostics) finding(report, diagnostic, out);
    if (!report.truncated) return;
    out += fmt::format("{}: {}: {}\n\n", style_.paint(Ink::strong, "note"), safe(report.path),
                       truncation_note(report));
  }

  void end(const RunSummary& summary, std::string& out) override {
    if (!quiet_) print_summary(summary, out);
  }

 private:
  void finding(const FileReport& report, const Diagnostic& diagnostic, std::string& out) const {
    const std::string margin(gutter_width(diagnostic), ' ');
    const std::string label =
        fmt::format("{}[{}]", severity_name(diagnostic.severity), safe(diagnostic.code));
    out += style_.paint(ink_of(diagnostic.severity), label);
    out += style_.paint(Ink::strong, fmt::format(": {}", safe(diagnostic.message))) + "\n";
    out += margin + style_.paint(Ink::frame, "-->") + " ";
    out += file_place(report, diagnostic) + document_place(diagnostic) + "\n";
    if (diagnostic.location.line > 0) out += excerpt_lines(diagnostic, style_);
    remark(margin, Ink::help, "help", safe(diagnostic.help), out);
    remark(margin, Ink::strong, "note", repeat_note(diagnostic), out);
    out += "\n";
  }

  // Precondition: `text` is neutralised.
  void remark(std::string_view margin, Ink ink, std::string_view label, std::string_view text,
              std::string& out) const {
    if (text.empty()) return;
    out += fmt::format("{} {} {}: {}\n", margin, style_.paint(Ink::frame, "="),
                       style_.paint(ink, label), text);
  }

  // "1 error, 3 warnings, 2 infos", without what there is none of.
  std::string tally(const RunSummary& summary) const {
    const Counts& counts = summary.counts;
    std::string text;
    const auto add = [&](Severity severity, std::uint64_t count) {
      if (count == 0) return;
      if (!text.empty()) text += ", ";
      text += style_.paint(ink_of(severity), counted(count, severity_name(severity)));
    };
    add(Severity::error, counts.errors);
    add(Severity::warning, counts.warnings);
    add(Severity::info, counts.infos);
    add(Severity::hint, counts.hints);
    if (!text.empty()) return text;
    return style_.paint(
        Ink::good, summary.suppressed + summary.unchanged > 0 ? "no new problems" : "no problems");
  }

  void print_summary(const RunSummary& summary, std::string& out) const {
    out += counted(summary.files, "file") + " checked: " + tally(summary) + "\n";
    if (const auto note = pixels_note(summary, pixel_level_); !note.empty()) out += note + "\n";
    if (summary.unreadable > 0) {
      out += counted(summary.unreadable, "file") + " could not be read\n";
    }
    if (summary.unverified > 0) out += unverified_note(summary.unverified) + "\n";
    if (summary.suppressed > 0) {
      out += counted(summary.suppressed, "finding") + " known to the baseline\n";
    }
    if (summary.left_out > 0) out += left_out_note(summary.left_out) + "\n";
    if (summary.unchanged > 0) out += unchanged_note(summary.unchanged) + "\n";
    if (summary.counts.at_least(Severity::hint) > 0) {
      out += fmt::format("`{} explain CODE` tells more about a finding\n", safe(command_));
    }
  }

  Style style_;
  bool quiet_;
  std::string command_;
  std::string pixel_level_;
};

}  // namespace

std::unique_ptr<ReportWriter> make_text_writer(const FormatOptions& options) {
  return std::make_unique<TextWriter>(options);
}

}  // namespace gltfx::report
