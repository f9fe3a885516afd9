// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <utility>

#include "report/writers.hpp"

namespace gltfx::report {
namespace {

class MinSeverityWriter final : public ReportWriter {
 public:
  MinSeverityWriter(std::unique_ptr<ReportWriter> writer, Severity least)
      : writer_(std::move(writer)), least_(least) {}

  void begin(std::string& out) override { writer_->begin(out); }
  void file(const FileReport& report, std::string& out) override {
    const bool all = std::all_of(report.diagnostics.begin(), report.diagnostics.end(),
                                 [this](const Diagnostic& finding) { return is_listed(finding); });
    writer_->file(all ? report : listed(report), out);
  }
  void end(const RunSummary& summary, std::string& out) override { writer_->end(summary, out); }

 private:
  bool is_listed(const Diagnostic& finding) const { return finding.severity <= least_; }

  FileReport listed(const FileReport& report) const {
    FileReport kept = report;
    std::vector<std::size_t> places(report.diagnostics.size());
    std::size_t next = 0;
    for (std::size_t i = 0; i < places.size(); ++i) {
      places[i] = next;
      if (!is_listed(report.diagnostics[i])) continue;
      if (next != i) kept.diagnostics[next] = std::move(kept.diagnostics[i]);
      ++next;
    }
    kept.diagnostics.resize(next);
    std::erase_if(kept.repeats, [&](const Repeat& repeat) {
      return !is_listed(report.diagnostics[repeat.finding]);
    });
    for (Repeat& repeat : kept.repeats) repeat.finding = places[repeat.finding];
    return kept;
  }

  std::unique_ptr<ReportWriter> writer_;
  Severity least_;
};

}  // namespace

std::unique_ptr<ReportWriter> with_min_severity(std::unique_ptr<ReportWriter> writer,
                                                Severity least) {
  return std::make_unique<MinSeverityWriter>(std::move(writer), least);
}

}  // namespace gltfx::report
