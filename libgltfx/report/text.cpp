// SPDX-License-Identifier: Apache-2.0
// For people: a block a finding, as compilers print it, and a summary at the end.
#include <string>
#include <vector>

#include <fmt/format.h>

#include "report/excerpt.hpp"
#include "report/safe_text.hpp"
#include "report/style.hpp"
#include "report/text_summary.hpp"
#include "report/wording.hpp"
#include "report/writers.hpp"

namespace gltfx::report {
namespace {

class TextWriter final : public ReportWriter {
 public:
  explicit TextWriter(const FormatOptions& options) : options_(options), style_(options.color) {}

  void begin(std::string&) override {}

  void file(const FileReport& report, std::string& out) override {
    for (const Diagnostic& diagnostic : report.diagnostics) finding(report, diagnostic, out);
    if (!report.truncated) return;
    out += fmt::format("{}: {}: {}\n\n", style_.paint(Ink::strong, "note"), safe(report.path),
                       truncation_note(report));
  }

  void end(const RunSummary& summary, std::string& out) override {
    if (!options_.quiet) out += text_summary(summary, options_);
  }

 private:
  void finding(const FileReport& report, const Diagnostic& diagnostic, std::string& out) const {
    const std::string margin(gutter_width(diagnostic), ' ');
    out += rule_label(style_, diagnostic.severity, diagnostic.code);
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

  FormatOptions options_;
  Style style_;
};

}  // namespace

std::unique_ptr<ReportWriter> make_text_writer(const FormatOptions& options) {
  if (options.layout == TextLayout::statistics) return make_statistics_writer(options);
  if (options.layout == TextLayout::by_rule) return make_grouped_writer(options);
  return std::make_unique<TextWriter>(options);
}

}  // namespace gltfx::report
