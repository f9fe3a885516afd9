// SPDX-License-Identifier: Apache-2.0
#include "known_findings.hpp"

#include <filesystem>
#include <system_error>
#include <utility>

#include <fmt/format.h>

#include "base/text.hpp"
#include "output.hpp"
#include "read_input.hpp"
#include "report/wording.hpp"

namespace gltfx::tool {

Result<KnownFindings> KnownFindings::load(const std::string& file, const std::string& record_to,
                                          std::uint64_t max_issues) {
  KnownFindings known;
  known.record_to_ = record_to;
  known.max_issues_ = max_issues;
  std::error_code error;
  const bool first = known.recording() && !std::filesystem::exists(file, error) && !error;
  if (file.empty() || first) return known;
  const auto text = read_text_file(file, kLongestList);
  if (!text) {
    const bool missing = !std::filesystem::exists(file, error) && !error;
    return Error{"--baseline: " + text.error().message +
                 (missing ? "; --write-baseline FILE records one" : "")};
  }
  auto baseline = report::Baseline::parse(*text);
  if (!baseline) {
    return Error{"--baseline: " + quoted(file, 200) + ": " + baseline.error().message};
  }
  known.baseline_ = *std::move(baseline);
  return known;
}

void KnownFindings::apply(FileReport& report) {
  if (!active()) return;
  if (recording()) record(report);
  if (baseline_) baseline_->apply(report);
  if (max_issues_ == 0 || report.diagnostics.size() <= max_issues_) return;
  report.diagnostics.resize(max_issues_);
  report.repeats.clear();
  report.truncated = true;
}

void KnownFindings::record(const FileReport& report) {
  recorded_.add(report);
  if (!report.readable || report.diagnostics.empty()) return;
  ++files_;
  for (const Diagnostic& finding : report.diagnostics) findings_ += finding.count;
}

std::string KnownFindings::note() const {
  using report::counted;
  return fmt::format("note: {} in {} recorded in {}", counted(findings_, "finding"),
                     counted(files_, "file"), quoted(record_to_, 200));
}

std::string KnownFindings::write() const {
  if (!recording()) return {};
  Output file(record_to_);
  file.write(recorded_.text());
  file.finish();
  return file.problem();
}

}  // namespace gltfx::tool
