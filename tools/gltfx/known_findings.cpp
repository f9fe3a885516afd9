// SPDX-License-Identifier: Apache-2.0
#include "known_findings.hpp"

#include <utility>

#include "base/text.hpp"
#include "output.hpp"
#include "read_input.hpp"

namespace gltfx::tool {

Result<KnownFindings> KnownFindings::load(const std::string& file, const std::string& record_to,
                                          std::uint64_t max_issues) {
  KnownFindings known;
  known.record_to_ = record_to;
  known.max_issues_ = max_issues;
  if (file.empty()) return known;
  const auto text = read_text_file(file, kLongestList);
  if (!text) return Error{"--baseline: " + text.error().message};
  auto baseline = report::Baseline::parse(*text);
  if (!baseline) {
    return Error{"--baseline: " + quoted(file, 200) + ": " + baseline.error().message};
  }
  known.baseline_ = *std::move(baseline);
  return known;
}

void KnownFindings::apply(FileReport& report) {
  if (!active()) return;
  if (recording()) recorded_.add(report);
  if (baseline_) baseline_->apply(report);
  if (max_issues_ == 0 || report.diagnostics.size() <= max_issues_) return;
  report.diagnostics.resize(max_issues_);
  report.repeats.clear();
  report.truncated = true;
}

std::string KnownFindings::write() const {
  if (!recording()) return {};
  Output file(record_to_);
  file.write(recorded_.text());
  file.finish();
  return file.problem();
}

}  // namespace gltfx::tool
