// SPDX-License-Identifier: Apache-2.0
// For people who fix one rule at a time: a block for each rule, with its first places.
#include <algorithm>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "report/safe_text.hpp"
#include "report/style.hpp"
#include "report/text_summary.hpp"
#include "report/wording.hpp"
#include "report/writers.hpp"

namespace gltfx::report {
namespace {

constexpr std::size_t kMostPlaces = 10;  // that are listed for a rule

class GroupedWriter final : public ReportWriter {
 public:
  explicit GroupedWriter(const FormatOptions& options) : options_(options), style_(options.color) {}

  void begin(std::string&) override {}

  void file(const FileReport& report, std::string&) override {
    for (const Diagnostic& finding : report.diagnostics) {
      Group& group = groups_[{finding.severity, std::string(finding.code)}];
      group.findings += finding.count;
      if (group.last_file != report.path) ++group.files;
      group.last_file = report.path;
      if (group.places.size() == kMostPlaces) continue;
      group.listed += finding.count;
      group.places.push_back(file_place(report, finding) + document_place(finding) + ": " +
                             safe(finding.message));
      if (const auto note = repeat_note(finding); !note.empty()) {
        group.places.back() += " (" + note + ")";
      }
    }
  }

  void end(const RunSummary& summary, std::string& out) override {
    for (const auto& [rule, group] : groups_) block(rule.first, rule.second, group, out);
    if (!options_.quiet) out += text_summary(summary, options_);
  }

 private:
  struct Group {
    std::uint64_t findings = 0, files = 0, listed = 0;
    std::vector<std::string> places;
    std::string last_file;
  };

  void block(Severity severity, const std::string& code, const Group& group,
             std::string& out) const {
    out += rule_label(style_, severity, code);
    out +=
        style_.paint(Ink::strong, fmt::format(": {} ({} in {})", rule_summary(options_.rules, code),
                                              counted(group.findings, "finding"),
                                              counted(group.files, "file"))) +
        "\n";
    for (const std::string& place : group.places) {
      out += " " + style_.paint(Ink::frame, "-->") + " " + place + "\n";
    }
    if (group.findings > group.listed) {
      out += fmt::format("     and {} more\n", group.findings - group.listed);
    }
    out += "\n";
  }

  FormatOptions options_;
  Style style_;
  std::map<std::pair<Severity, std::string>, Group> groups_;
};

}  // namespace

std::unique_ptr<ReportWriter> make_grouped_writer(const FormatOptions& options) {
  return std::make_unique<GroupedWriter>(options);
}

}  // namespace gltfx::report
