// SPDX-License-Identifier: Apache-2.0
// The report structure of the Khronos glTF validator, for tools that read its reports.
#include <gltfx/version.hpp>

#include <string>
#include <string_view>

#include "json/writer.hpp"
#include "report/entry.hpp"
#include "report/safe_text.hpp"
#include "report/writers.hpp"

namespace gltfx::report {
namespace {

// In that report the root object is "/"; only findings on the text, or on a root that is not an
// object, have the empty pointer of RFC 6901.
std::string_view pointer_of(const FileReport& report, const Diagnostic& finding) {
  if (!finding.pointer.empty() || report.mime_type.empty()) return finding.pointer;
  const bool on_text = finding.code == "INVALID_JSON" || finding.code == "TYPE_MISMATCH" ||
                       finding.code.substr(0, 5) == "JSON_";
  return on_text ? "" : "/";
}

std::string_view right_trimmed(std::string_view text) {
  return text.substr(0, text.find_last_not_of(" \t\r\n") + 1);
}

void write_message(json::Writer& writer, const FileReport& report, const Diagnostic& finding) {
  writer.begin_object();
  writer.member("code", finding.code);
  writer.member("message", right_trimmed(finding.message));
  writer.member("severity", static_cast<std::uint64_t>(finding.severity));
  if (finding.offset) {
    writer.member("offset", *finding.offset);
  } else {
    writer.member("pointer", pointer_of(report, finding));
  }
  writer.end_object();
}

// The counts of a truncated report are those of its messages.
Counts counts_of(const FileReport& report) {
  if (!report.truncated) return report.counts;
  Counts counts;
  for (const Diagnostic& finding : report.diagnostics) counts.add(finding.severity, finding.count);
  return counts;
}

void write_issues(json::Writer& writer, const FileReport& report) {
  const Counts counts = counts_of(report);
  writer.begin_object();
  writer.member("numErrors", counts.errors);
  writer.member("numWarnings", counts.warnings);
  writer.member("numInfos", counts.infos);
  writer.member("numHints", counts.hints);
  writer.key("messages");
  writer.begin_array();
  for (const Diagnostic& finding : report.diagnostics) write_message(writer, report, finding);
  writer.end_array();
  writer.member("truncated", report.truncated);
  writer.end_object();
}

std::string object_text(const FileReport& report) {
  std::string out;
  out.reserve(1024);  // size of the report of an asset without findings
  json::Writer writer(out, true);
  writer.begin_object();
  writer.member("uri", report.path);
  if (!report.mime_type.empty()) writer.member("mimeType", report.mime_type);
  writer.member("validatorVersion", version());
  writer.key("issues");
  write_issues(writer, report);
  if (report.info) {
    writer.key("info");
    write_asset_info(writer, *report.info);
  }
  writer.end_object();
  defuse_json(out, 0);
  return out;
}

// Strings have no line breaks, so every line break is the writer's.
void append_indented(std::string& out, std::string_view text) {
  out += "  ";
  for (const char c : text) {
    out += c;
    if (c == '\n') out += "  ";
  }
}

class KhronosWriter final : public ReportWriter {
 public:
  void begin(std::string&) override {}

  void file(const FileReport& report, std::string& out) override {
    ++files_;
    if (files_ == 1) {
      first_ = object_text(report);
      return;
    }
    if (files_ == 2) {
      out += "[\n";
      append_indented(out, first_);
      first_.clear();
    }
    out += ",\n";
    append_indented(out, object_text(report));
  }

  void end(const RunSummary&, std::string& out) override {
    if (files_ == 0) {
      out += "[]\n";
    } else if (files_ == 1) {
      first_ += '\n';
      out += first_;
    } else {
      out += "\n]\n";
    }
  }

 private:
  std::uint64_t files_ = 0;
  std::string first_;
};

}  // namespace

std::unique_ptr<ReportWriter> make_khronos_writer() { return std::make_unique<KhronosWriter>(); }

}  // namespace gltfx::report
