// SPDX-License-Identifier: Apache-2.0
// Workflow commands of GitHub Actions: each finding becomes an annotation on its line.
// https://docs.github.com/actions/reference/workflow-commands-for-github-actions
#include <string>
#include <string_view>

#include <fmt/format.h>

#include "report/safe_text.hpp"
#include "report/wording.hpp"
#include "report/writers.hpp"

namespace gltfx::report {
namespace {

std::string escaped(std::string_view text, std::string_view special) {
  std::string out;
  for (const char c : text) {
    if (special.find(c) == std::string_view::npos) {
      out += c;
    } else {
      out += fmt::format("%{:02X}", static_cast<unsigned char>(c));
    }
  }
  return out;
}

std::string escaped_message(std::string_view text) { return escaped(text, "%\r\n"); }
std::string escaped_property(std::string_view text) { return escaped(text, "%\r\n:,"); }

std::string_view command_of(Severity severity) {
  if (severity == Severity::error) return "error";
  return severity == Severity::warning ? "warning" : "notice";
}

// GitHub refuses columns across lines.
std::string location_properties(const FileReport& report, const Location& at) {
  if (!is_in_file_line(report, at)) return {};
  std::string out = fmt::format(",line={},endLine={}", at.line, at.end_line);
  if (at.line == at.end_line) {
    out += fmt::format(",col={},endColumn={}", at.column, at.end_column);
  }
  return out;
}

std::string byte_place(const FileReport& report, const Diagnostic& finding) {
  if (finding.offset) return fmt::format(" at byte {}", *finding.offset);
  if (finding.location.line == 0 || !is_glb(report)) return {};
  return fmt::format(" at byte {}", finding.location.offset);
}

// All asset text here is neutralised; line breaks come from the format.
std::string message_text(const FileReport& report, const Diagnostic& finding) {
  std::string text = safe(finding.message);
  const std::string place = byte_place(report, finding) + document_place(finding);
  if (!place.empty()) text.append("\n").append(place, 1);
  if (!finding.help.empty()) text.append("\nhelp: ").append(safe(finding.help));
  if (finding.count > 1) text.append("\nnote: ").append(repeat_note(finding));
  return text;
}

class GithubWriter final : public ReportWriter {
 public:
  explicit GithubWriter(const FormatOptions& options) : pixel_level_(options.pixel_level) {}

  void begin(std::string&) override {}

  void file(const FileReport& report, std::string& out) override {
    const std::string path = escaped_property(safe(report.path));
    for (const Diagnostic& finding : report.diagnostics) {
      out += fmt::format("::{} file={}{},title={}::{}\n", command_of(finding.severity), path,
                         location_properties(report, finding.location),
                         escaped_property(safe(finding.code)),
                         escaped_message(message_text(report, finding)));
    }
    if (!report.truncated) return;
    out += fmt::format("::notice file={},title=gltfx::{}\n", path, truncation_note(report));
  }

  void end(const RunSummary& summary, std::string& out) override {
    if (summary.unverified != 0) {
      out += fmt::format("::notice title=gltfx::{}\n", unverified_note(summary.unverified));
    }
    if (summary.images_decoded < summary.images_wanted) {
      out += fmt::format("::notice title=gltfx::{}\n", pixels_note(summary, pixel_level_));
    }
    if (summary.unchanged != 0) {
      out += fmt::format("::notice title=gltfx::{}\n", unchanged_note(summary.unchanged));
    }
    // A plain line of the log, not an annotation.
    if (!pixel_level_.empty()) {
      out += fmt::format("gltfx: {} checked, pixels: {}\n", counted(summary.files, "file"),
                         pixel_level_);
    }
  }

 private:
  std::string pixel_level_;
};

}  // namespace

std::unique_ptr<ReportWriter> make_github_writer(const FormatOptions& options) {
  return std::make_unique<GithubWriter>(options);
}

}  // namespace gltfx::report
