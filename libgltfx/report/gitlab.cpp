// SPDX-License-Identifier: Apache-2.0
// Code Quality reports of GitLab: findings in the widget and on the lines of a merge request.
// GitLab compares the fingerprints of two branches to tell which findings are new, and shows one
// finding for each fingerprint; it links to a file only by its path in the repository.
// https://docs.gitlab.com/ci/testing/code_quality/#code-quality-report-format
#include <cstdint>
#include <map>
#include <string>
#include <string_view>

#include <fmt/format.h>

#include "base/hash.hpp"
#include "json/writer.hpp"
#include "report/file_uri.hpp"
#include "report/occurrences.hpp"
#include "report/safe_text.hpp"
#include "report/wording.hpp"
#include "report/writers.hpp"

namespace gltfx::report {
namespace {

std::string_view severity_in_gitlab(const FileReport& report, Severity severity) {
  if (!report.readable) return "critical";
  if (severity == Severity::error) return "major";
  return severity == Severity::warning ? "minor" : "info";
}

std::string description_of(const Diagnostic& finding) {
  std::string text = message_with_help(finding);
  if (!finding.pointer.empty()) text += fmt::format(" Found{}.", document_place(finding));
  if (finding.count > 1) text += fmt::format(" Note: {}.", repeat_note(finding));
  return text;
}

class GitlabWriter final : public ReportWriter {
 public:
  explicit GitlabWriter(const FormatOptions& options)
      : folder_(options.folder),
        repository_(options.repository.empty() ? options.folder : options.repository) {}

  void begin(std::string& out) override { out += '['; }

  void file(const FileReport& report, std::string& out) override {
    const std::string path = path_of(report);
    const std::uint64_t number = met_[path]++;
    Identities identities;
    for_each_occurrence(report, [&](const Diagnostic& finding) {
      HashParts parts;
      parts.add(path);
      parts.add(number);
      parts.add(identities.next(finding).label());
      const std::size_t from = out.size();
      out += has_findings_ ? ",\n" : "\n";
      has_findings_ = true;
      json::Writer writer(out);
      write(writer, report, path, finding, parts.finish());
      defuse_json(out, from);
    });
  }

  void end(const RunSummary&, std::string& out) override { out += has_findings_ ? "\n]\n" : "]\n"; }

 private:
  std::string path_of(const FileReport& report) const {
    if (report.path == "-") return report.path;
    const std::string whole = folder_.empty() || report.path.starts_with('/')
                                  ? report.path
                                  : fmt::format("{}/{}", folder_, report.path);
    return path_below(whole, repository_);
  }

  static void write(json::Writer& writer, const FileReport& report, const std::string& path,
                    const Diagnostic& finding, const Hash128& fingerprint) {
    writer.begin_object();
    writer.member("description", description_of(finding));
    writer.member("check_name", finding.code);
    writer.member("fingerprint", fmt::format("{:016x}{:016x}", fingerprint.high, fingerprint.low));
    writer.member("severity", severity_in_gitlab(report, finding.severity));
    writer.key("location");
    writer.begin_object();
    writer.member("path", path);
    writer.key("lines");
    writer.begin_object();
    const Location& at = finding.location;
    writer.member("begin", std::uint64_t{is_in_file_line(report, at) ? at.line : 1});
    writer.end_object();
    writer.end_object();
    writer.end_object();
  }

  std::string folder_, repository_;
  std::map<std::string, std::uint64_t, std::less<>> met_;  ///< reports of each path
  bool has_findings_ = false;
};

}  // namespace

std::unique_ptr<ReportWriter> make_gitlab_writer(const FormatOptions& options) {
  return std::make_unique<GitlabWriter>(options);
}

}  // namespace gltfx::report
