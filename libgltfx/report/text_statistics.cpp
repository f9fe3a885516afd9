// SPDX-License-Identifier: Apache-2.0
// For people who start with many findings: which rules and which files have most of them.
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

std::unique_ptr<ReportWriter> make_statistics_writer(const FormatOptions& options) {
  return std::make_unique<StatisticsWriter>(options);
}

}  // namespace gltfx::report
