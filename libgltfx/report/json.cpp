// SPDX-License-Identifier: Apache-2.0
// For programs: one object a run, one line a file. json_schema.cpp describes it.
#include <gltfx/version.hpp>

#include "json/writer.hpp"
#include "report/asset_info.hpp"
#include "report/safe_text.hpp"
#include "report/writers.hpp"

namespace gltfx::report {
namespace {

// Raised when a reader of the format before could misread the next.
constexpr std::uint64_t kFormat = 1;

void write_counts(json::Writer& writer, const Counts& counts) {
  writer.member("errors", counts.errors);
  writer.member("warnings", counts.warnings);
  writer.member("infos", counts.infos);
  writer.member("hints", counts.hints);
}

void write_location(json::Writer& writer, const Location& at) {
  writer.begin_object();
  writer.member("line", std::uint64_t{at.line});
  writer.member("column", std::uint64_t{at.column});
  writer.member("endLine", std::uint64_t{at.end_line});
  writer.member("endColumn", std::uint64_t{at.end_column});
  writer.member("byte", at.offset);
  writer.member("length", at.length);
  writer.end_object();
}

void write_finding(json::Writer& writer, const Diagnostic& finding, bool readable) {
  writer.begin_object();
  writer.member("code", finding.code);
  writer.member("severity", severity_name(finding.severity));
  writer.member("message", finding.message);
  if (!finding.help.empty()) writer.member("help", finding.help);
  if (finding.offset) {
    writer.member("offset", *finding.offset);
  } else if (readable) {
    writer.member("pointer", finding.pointer);
  }
  if (finding.location.line > 0) {
    writer.key("location");
    write_location(writer, finding.location);
  }
  if (!finding.object_name.empty()) writer.member("object", finding.object_name);
  if (finding.count > 1) {
    writer.member("count", finding.count);
    writer.member("lastPointer", finding.last_pointer);
  }
  writer.end_object();
}

void write_file(json::Writer& writer, const FileReport& report) {
  writer.begin_object();
  writer.member("path", report.path);
  if (!report.mime_type.empty()) writer.member("mimeType", report.mime_type);
  writer.member("readable", report.readable);
  writer.key("counts");
  writer.begin_object();
  write_counts(writer, report.counts);
  writer.end_object();
  writer.member("truncated", report.truncated);
  writer.member("suppressed", report.suppressed);
  writer.member("leftOut", report.left_out);
  writer.member("unverified", report.unverified);
  writer.key("findings");
  writer.begin_array();
  for (const Diagnostic& finding : report.diagnostics) {
    write_finding(writer, finding, report.readable);
  }
  writer.end_array();
  if (report.info) {
    writer.key("info");
    write_asset_info(writer, *report.info);
  }
  writer.end_object();
}

void write_summary(json::Writer& writer, const RunSummary& summary) {
  writer.begin_object();
  writer.member("files", summary.files);
  writer.member("filesWithErrors", summary.files_with_errors);
  writer.member("unreadable", summary.unreadable);
  writer.member("unverified", summary.unverified);
  writer.member("suppressed", summary.suppressed);
  writer.member("leftOut", summary.left_out);
  write_counts(writer, summary.counts);
  writer.end_object();
}

class JsonWriter final : public ReportWriter {
 public:
  explicit JsonWriter(const FormatOptions& options)
      : profile_(options.profile), pixel_level_(options.pixel_level) {}

  void begin(std::string& out) override {
    json::Writer writer(out);
    writer.begin_object();
    writer.member("gltfx", version());
    writer.member("format", kFormat);
    if (!profile_.empty()) writer.member("profile", profile_);
    if (!pixel_level_.empty()) writer.member("pixels", pixel_level_);
    writer.key("files");
    out += '[';
  }

  void file(const FileReport& report, std::string& out) override {
    const std::size_t from = out.size();
    out += has_files_ ? ",\n" : "\n";
    has_files_ = true;
    json::Writer writer(out);
    write_file(writer, report);
    defuse_json(out, from);
  }

  void end(const RunSummary& summary, std::string& out) override {
    out += has_files_ ? "\n],\"summary\":" : "],\"summary\":";
    json::Writer writer(out);
    write_summary(writer, summary);
    out += "}\n";
  }

 private:
  std::string profile_;
  std::string pixel_level_;
  bool has_files_ = false;
};

}  // namespace

std::unique_ptr<ReportWriter> make_json_writer(const FormatOptions& options) {
  return std::make_unique<JsonWriter>(options);
}

}  // namespace gltfx::report
