// SPDX-License-Identifier: Apache-2.0
#include "report_targets.hpp"

#include <filesystem>
#include <system_error>

#include <unistd.h>

#include "repository.hpp"
#include "terminal.hpp"

namespace gltfx::tool {
namespace {

FormatOptions format_options(const ReportRequest& request, const ReportTargets::Look& look,
                             const FormatTarget& target) {
  FormatOptions options;
  options.color = target.path.empty() ? colors_on_stdout(request.common.color)
                                      : request.common.color == ColorMode::always;
  options.quiet = request.quiet;
  options.layout = request.layout;
  // On a terminal, hundreds of infos would hide important findings.
  const bool listed_for_people = target.format == ReportFormat::text && target.path.empty() &&
                                 request.layout != TextLayout::statistics &&
                                 ::isatty(STDOUT_FILENO) == 1;
  options.min_severity =
      request.min_severity.value_or(listed_for_people ? Severity::warning : Severity::hint);
  options.command = "gltfx";
  options.profile = look.profile;
  options.pixel_level = look.pixel_level;
  options.shard = look.shard;
  options.rules = rules(request.own_rules.get());
  std::error_code error;
  options.folder = std::filesystem::current_path(error).native();
  options.repository = repository_of(options.folder).native();
  options.fail_on = request.fail_on;
  options.sarif_notes = request.sarif_notes;
  options.timings = request.timings;
  return options;
}

}  // namespace

ReportTargets::ReportTargets(const ReportRequest& request, const Look& look) {
  for (const FormatTarget& target : request.targets) {
    targets_.push_back({Output(target.path),
                        make_report_writer(target.format, format_options(request, look, target)),
                        {},
                        target.path.empty() && (::isatty(STDOUT_FILENO) == 1 ||
                                                target.format == ReportFormat::jsonl)});
  }
}

void ReportTargets::flush(Target& target, std::size_t above) {
  if (target.pending.size() <= above) return;
  if (target.immediate && before_output_) before_output_();
  target.output.write(target.pending);
  target.pending.clear();
}

void ReportTargets::begin() {
  for (Target& target : targets_) target.writer->begin(target.pending);
}

void ReportTargets::file(const FileReport& report) {
  for (Target& target : targets_) {
    target.writer->file(report, target.pending);
    flush(target, target.immediate ? 0 : kOutputBuffer);
  }
}

void ReportTargets::finish(const RunSummary& summary) {
  for (Target& target : targets_) {
    target.writer->end(summary, target.pending);
    flush(target, 0);
    target.output.finish();
  }
}

std::string ReportTargets::problems() const {
  std::string lines;
  for (const Target& target : targets_) {
    if (target.output.problem().empty()) continue;
    lines += (lines.empty() ? "" : "\n") + target.output.problem();
  }
  return lines;
}

}  // namespace gltfx::tool
