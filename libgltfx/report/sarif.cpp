// SPDX-License-Identifier: Apache-2.0
// Static Analysis Results Interchange Format 2.1.0, for code scanning services and editors. Data
// that is only known at the end of a run (rules in use, files, outcome) comes after the results.
// Each repeat of a finding is a separate result, because services track results from run to run.
// https://docs.oasis-open.org/sarif/sarif/v2.1.0/errata01/sarif-v2.1.0-errata01.html

#include <string>
#include <string_view>

#include <fmt/format.h>

#include "base/hash.hpp"
#include "json/writer.hpp"
#include "report/entry.hpp"
#include "report/file_uri.hpp"
#include "report/occurrences.hpp"
#include "report/safe_text.hpp"
#include "report/sarif_parts.hpp"
#include "report/wording.hpp"
#include "report/writers.hpp"

namespace gltfx::report {
namespace {

constexpr std::string_view kSchema =
    "https://docs.oasis-open.org/sarif/sarif/v2.1.0/errata01/os/schemas/sarif-schema-2.1.0.json";
constexpr std::string_view kBase = "SRCROOT";

// Of a GLB, only the byte is written. Services show nothing without a line, so the first line is
// used for the file.
void write_region(json::Writer& writer, const FileReport& report, const Location& at) {
  writer.begin_object();
  if (is_glb(report)) {
    writer.member("startLine", std::uint64_t{1});
  } else {
    writer.member("startLine", std::uint64_t{at.line});
    writer.member("startColumn", std::uint64_t{at.utf16_column});
    writer.member("endLine", std::uint64_t{at.end_line});
    writer.member("endColumn", std::uint64_t{at.utf16_end_column});
  }
  writer.member("byteOffset", at.offset);
  writer.member("byteLength", at.length);
  writer.end_object();
}

// The place of a finding on the whole file: services require a line.
Location start_of_file() {
  Location at;
  at.line = at.end_line = at.utf16_column = at.utf16_end_column = 1;
  return at;
}

FileUri uri_of(const FileReport& report, std::string_view folder) {
  if (report.path == "-") return {"stdin:", false};
  return file_uri(report.path, folder);
}

void write_byte(json::Writer& writer, std::uint64_t offset) {
  writer.begin_object();
  writer.member("startLine", std::uint64_t{1});
  writer.member("byteOffset", offset);
  writer.member("byteLength", std::uint64_t{0});
  writer.end_object();
}

void write_pointer(json::Writer& writer, std::string_view pointer) {
  writer.key("logicalLocations");
  writer.begin_array();
  writer.begin_object();
  writer.member("fullyQualifiedName", pointer);
  writer.end_object();
  writer.end_array();
}

// GitHub compares only `primaryLocationLineHash`. The value that its upload action computes
// otherwise is the same for all findings of one line, and a whole asset may be on one line.
void write_fingerprint(json::Writer& writer, const Identity& identity) {
  writer.key("partialFingerprints");
  writer.begin_object();
  writer.member("codeAndPlace/v2", identity.label());
  writer.member("primaryLocationLineHash",
                fmt::format("{:016x}:{}", hash_bytes(identity.text).low, identity.number));
  writer.end_object();
}

std::string left_out_text(const Counts& left_out) {
  return fmt::format(
      "Only {} results are listed, as many as code-scanning services show; left out: {}, {}, {}",
      SarifResults::kMost, counted(left_out.errors, "error"), counted(left_out.warnings, "warning"),
      counted(left_out.infos + left_out.hints, "note"));
}

class SarifWriter final : public ReportWriter {
 public:
  explicit SarifWriter(const FormatOptions& options) : options_(options), rules_(options.rules) {}

  void begin(std::string& out) override {
    json::Writer writer(out);
    writer.begin_object();
    writer.member("$schema", kSchema);
    writer.member("version", "2.1.0");
    writer.key("runs");
    out += "[{";
    out += R"("columnKind":"utf16CodeUnits","newlineSequences":["\r\n","\n","\r"],)";
    write_base(out);
    out += R"("results":[)";
  }

  void file(const FileReport& report, std::string&) override {
    const FileUri uri = uri_of(report, options_.folder);
    Identities identities;
    for_each_occurrence(report, [&](const Diagnostic& finding) {
      const Identity identity = identities.next(finding);
      if (!is_wanted(finding.severity)) {
        notes_ += finding.count;
        return;
      }
      results_.add(finding.severity, [&](std::string& text) {
        json::Writer writer(text);
        write_result(writer, report, uri, finding, identity);
        defuse_json(text, 0);
      });
    });
    if (report.truncated) notify(Severity::warning, truncation_note(report), &uri);
    add_artifact(report, uri);
    ++files_;
  }

  void end(const RunSummary& summary, std::string& out) override {
    if (summary.images_decoded < summary.images_wanted) {
      notify(Severity::info, pixels_note(summary, options_.pixel_level), nullptr);
    }
    if (summary.unverified > 0) {
      notify(Severity::info, unverified_note(summary.unverified), nullptr);
    }
    if (summary.unchanged > 0) notify(Severity::info, unchanged_note(summary.unchanged), nullptr);
    if (notes_ > 0) {
      notify(Severity::info, counted(notes_, "note") + " not listed (--sarif-notes lists them)",
             nullptr);
    }
    if (const Counts& left_out = results_.left_out(); left_out.at_least(Severity::hint) > 0) {
      notify(Severity::warning, left_out_text(left_out), nullptr);
    }
    results_.write(out);
    out += "\n],\"tool\":";
    rules_.write_tool(out);
    out.append(",\n\"artifacts\":[").append(artifacts_).append("],\n\"invocations\":[");
    write_invocation(summary, out);
    out += "],\n\"properties\":";
    json::Writer writer(out);
    writer.begin_object();
    writer.member("profile", options_.profile);
    writer.member("pixels", options_.pixel_level);
    writer.end_object();
    out += "}]}\n";
  }

 private:
  bool is_wanted(Severity severity) const {
    return severity <= Severity::warning || options_.sarif_notes ||
           (options_.fail_on && severity <= *options_.fail_on);
  }

  void write_base(std::string& out) const {
    if (options_.folder.empty()) return;
    out += R"("originalUriBaseIds":)";
    const std::size_t from = out.size();
    json::Writer writer(out);
    writer.begin_object();
    writer.key(kBase);
    writer.begin_object();
    writer.member("uri", folder_uri(options_.folder));
    writer.end_object();
    writer.end_object();
    defuse_json(out, from);
    out += ',';
  }

  void write_artifact_location(json::Writer& writer, const FileUri& uri) const {
    writer.begin_object();
    writer.member("uri", uri.text);
    if (uri.relative) writer.member("uriBaseId", kBase);
    writer.member("index", files_);
    writer.end_object();
  }

  void write_location(json::Writer& writer, const FileReport& report, const FileUri& uri,
                      const Diagnostic& finding) const {
    writer.begin_object();
    writer.key("physicalLocation");
    writer.begin_object();
    writer.key("artifactLocation");
    write_artifact_location(writer, uri);
    if (finding.offset) {
      writer.key("region");
      write_byte(writer, *finding.offset);
    } else {
      writer.key("region");
      write_region(writer, report, finding.location.line > 0 ? finding.location : start_of_file());
    }
    writer.end_object();
    if (!finding.pointer.empty()) write_pointer(writer, long_value(finding.pointer));
    writer.end_object();
  }

  void write_result(json::Writer& writer, const FileReport& report, const FileUri& uri,
                    const Diagnostic& finding, const Identity& identity) {
    writer.begin_object();
    writer.member("ruleId", finding.code);
    writer.member("ruleIndex", rules_.index_of(finding.code, finding.severity));
    writer.member("level", sarif_level(finding.severity));
    writer.key("message");
    write_sarif_message(writer, message_with_help(finding));
    writer.key("locations");
    writer.begin_array();
    write_location(writer, report, uri, finding);
    writer.end_array();
    write_repeats(writer, finding);
    write_fingerprint(writer, identity);
    if (finding.fix && !is_glb(report)) write_fix(writer, report, uri, *finding.fix);
    if (!finding.object_name.empty() || finding.requirement) write_properties(writer, finding);
    writer.end_object();
  }

  static void write_properties(json::Writer& writer, const Diagnostic& finding) {
    writer.key("properties");
    writer.begin_object();
    if (!finding.object_name.empty()) writer.member("object", long_value(finding.object_name));
    if (finding.requirement) {
      writer.key("measure");
      write_checked_limit(writer, *finding.requirement);
    }
    writer.end_object();
  }

  static void write_repeats(json::Writer& writer, const Diagnostic& finding) {
    if (finding.count < 2) return;
    writer.member("occurrenceCount", finding.count);
    if (finding.last_pointer == finding.pointer || finding.last_pointer.empty()) return;
    writer.key("relatedLocations");
    writer.begin_array();
    writer.begin_object();
    writer.key("message");
    write_sarif_message(writer, "The last of the repeats.");
    write_pointer(writer, long_value(finding.last_pointer));
    writer.end_object();
    writer.end_array();
  }

  void write_fix(json::Writer& writer, const FileReport& report, const FileUri& uri,
                 const ProposedFix& fix) const {
    writer.key("fixes");
    writer.begin_array();
    writer.begin_object();
    writer.key("description");
    write_sarif_message(writer, fix.description);
    writer.key("artifactChanges");
    writer.begin_array();
    writer.begin_object();
    writer.key("artifactLocation");
    write_artifact_location(writer, uri);
    writer.key("replacements");
    writer.begin_array();
    for (const Replacement& replacement : fix.replacements) {
      writer.begin_object();
      writer.key("deletedRegion");
      write_region(writer, report, replacement.place);
      writer.key("insertedContent");
      writer.begin_object();
      writer.member("text", replacement.text);
      writer.end_object();
      writer.end_object();
    }
    writer.end_array();
    writer.end_object();
    writer.end_array();
    writer.end_object();
    writer.end_array();
  }

  void add_artifact(const FileReport& report, const FileUri& uri) {
    const std::size_t from = artifacts_.size();
    artifacts_ += files_ > 0 ? ",\n" : "\n";
    json::Writer writer(artifacts_);
    writer.begin_object();
    writer.key("location");
    write_artifact_location(writer, uri);
    if (!report.mime_type.empty()) writer.member("mimeType", report.mime_type);
    writer.key("roles");
    writer.begin_array();
    writer.string("analysisTarget");
    writer.end_array();
    writer.end_object();
    defuse_json(artifacts_, from);
  }

  // Notifications about the run itself.
  void notify(Severity severity, std::string_view text, const FileUri* uri) {
    notifications_ += notifications_.empty() ? "\n" : ",\n";
    json::Writer writer(notifications_);
    writer.begin_object();
    writer.member("level", sarif_level(severity));
    writer.key("message");
    write_sarif_message(writer, fmt::format("{}.", text));
    if (uri != nullptr) {
      writer.key("locations");
      writer.begin_array();
      writer.begin_object();
      writer.key("physicalLocation");
      writer.begin_object();
      writer.key("artifactLocation");
      write_artifact_location(writer, *uri);
      writer.end_object();
      writer.end_object();
      writer.end_array();
    }
    writer.end_object();
  }

  void write_invocation(const RunSummary& summary, std::string& out) const {
    json::Writer writer(out);
    writer.begin_object();
    writer.member("executionSuccessful", summary.unreadable == 0);
    if (summary.exit_code) {
      writer.key("exitCode");
      writer.integer(*summary.exit_code);
    }
    if (!notifications_.empty()) {
      writer.key("toolExecutionNotifications");
      writer.raw("[" + notifications_ + "]");
    }
    writer.end_object();
  }

  FormatOptions options_;
  SarifRules rules_;
  std::string artifacts_, notifications_;
  SarifResults results_;
  std::uint64_t files_ = 0;
  std::uint64_t notes_ = 0;  ///< findings that were not requested
};

}  // namespace

std::unique_ptr<ReportWriter> make_sarif_writer(const FormatOptions& options) {
  return std::make_unique<SarifWriter>(options);
}

}  // namespace gltfx::report
