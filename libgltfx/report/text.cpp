// SPDX-License-Identifier: Apache-2.0
// For people: a block per finding, as compilers print it, or a block per rule with its first
// places, or the rules and files with most findings; and a summary at the end.
#include <gltfx/report.hpp>

#include <algorithm>
#include <array>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "report/excerpt.hpp"
#include "report/rule_lookup.hpp"
#include "report/safe_text.hpp"
#include "report/wording.hpp"
#include "report/writers.hpp"

namespace gltfx::report {
namespace {

constexpr std::array kSeverities{Severity::error, Severity::warning, Severity::info,
                                 Severity::hint};

// Findings of that severity.
std::uint64_t count_of(const Counts& counts, Severity severity) {
  if (severity == Severity::error) return counts.errors;
  if (severity == Severity::warning) return counts.warnings;
  return severity == Severity::info ? counts.infos : counts.hints;
}

// "1 error, 3 warnings", from `first` to `last`, without zero counts.
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

// "4 infos and hints", which are not listed.
std::string unlisted_note(const RunSummary& summary, const FormatOptions& options) {
  const auto below = static_cast<Severity>(static_cast<int>(options.min_severity) + 1);
  const std::string text = tally(summary.counts, below, Severity::hint, Style(false));
  if (text.empty()) return {};
  return fmt::format("not listed: {} (--min-severity {} lists them)\n", text,
                     severity_name(summary.counts.hints > 0 ? Severity::hint : Severity::info));
}

// "error[NODE_LOOP]", the start of each finding and each group.
std::string rule_label(const Style& style, Severity severity, std::string_view code) {
  return style.paint(ink_of(severity), fmt::format("{}[{}]", severity_name(severity), safe(code)));
}

// The summary of the rule; empty when it is not in `rules`.
std::string_view rule_summary(std::span<const RuleDescription> rules, std::string_view code) {
  const RuleDescription* rule = find_rule_in(rules, code);
  return rule == nullptr ? std::string_view() : rule->summary;
}

// "3 files checked: 1 error, 4 infos", and a line for each thing that was left out. Ends with a
// line break.
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
  if (summary.fixable > 0) add(fixable_note(summary, options.profile));
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
      out += fmt::format(" {} {}\n", style_.paint(Ink::frame, "-->"), place);
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

constexpr std::size_t kMostFiles = 10;  // that are listed

struct RuleCount {
  std::uint64_t findings = 0, files = 0;
};
using Rule = std::pair<std::string, Severity>;

class StatisticsWriter final : public ReportWriter {
 public:
  explicit StatisticsWriter(const FormatOptions& options)
      : options_(options), style_(options.color) {}

  void begin(std::string&) override {}

  void file(const FileReport& report, std::string&) override {
    std::uint64_t sum = 0;
    std::map<std::pair<std::string_view, Severity>, std::uint64_t> own;
    for (const Diagnostic& finding : report.diagnostics) {
      own[{finding.code, finding.severity}] += finding.count;
      sum += finding.count;
    }
    for (const auto& [rule, count] : own) {
      RuleCount& all = rules_[{std::string(rule.first), rule.second}];
      all.findings += count;
      ++all.files;
    }
    if (sum == 0) return;
    files_.emplace_back(sum, report.path);
    std::stable_sort(files_.begin(), files_.end(),
                     [](const auto& a, const auto& b) { return a.first > b.first; });
    if (files_.size() > kMostFiles) files_.pop_back();
  }

  void end(const RunSummary& summary, std::string& out) override {
    std::vector<std::pair<Rule, RuleCount>> rows(rules_.begin(), rules_.end());
    std::stable_sort(rows.begin(), rows.end(), [](const auto& a, const auto& b) {
      return a.second.findings > b.second.findings;
    });
    if (!rows.empty()) out += style_.paint(Ink::strong, "findings   files  rule") + "\n";
    for (const auto& [rule, count] : rows) {
      out += fmt::format("{:>8} {:>7}  {}: {}\n", count.findings, count.files,
                         rule_label(style_, rule.second, rule.first),
                         rule_summary(options_.rules, rule.first));
    }
    if (!files_.empty()) out += "\n" + style_.paint(Ink::strong, "findings  file") + "\n";
    for (const auto& [count, path] : files_) out += fmt::format("{:>8}  {}\n", count, safe(path));
    if (!files_.empty()) out += "\n";
    if (!options_.quiet) out += text_summary(summary, options_);
  }

 private:
  FormatOptions options_;
  Style style_;
  std::map<Rule, RuleCount> rules_;
  std::vector<std::pair<std::uint64_t, std::string>> files_;  // most findings first
};

}  // namespace

std::unique_ptr<ReportWriter> make_text_writer(const FormatOptions& options) {
  if (options.layout == TextLayout::statistics) return make_statistics_writer(options);
  if (options.layout == TextLayout::by_rule) return make_grouped_writer(options);
  return std::make_unique<TextWriter>(options);
}

std::unique_ptr<ReportWriter> make_grouped_writer(const FormatOptions& options) {
  return std::make_unique<GroupedWriter>(options);
}

std::unique_ptr<ReportWriter> make_statistics_writer(const FormatOptions& options) {
  return std::make_unique<StatisticsWriter>(options);
}

}  // namespace gltfx::report
