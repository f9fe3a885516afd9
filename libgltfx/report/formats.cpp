// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <utility>

#include "report/writers.hpp"

namespace gltfx {
namespace {

/// In the order of ReportFormat.
constexpr std::array<std::string_view, 10> kNames{"text",   "json",  "jsonl", "khronos", "github",
                                                  "gitlab", "sarif", "junit", "agent",   "csv"};

}  // namespace

std::string_view report_format_name(ReportFormat format) {
  return kNames[static_cast<std::size_t>(format)];
}

std::optional<ReportFormat> report_format_from_name(std::string_view name) {
  const auto found = std::find(kNames.begin(), kNames.end(), name);
  if (found == kNames.end()) return std::nullopt;
  return static_cast<ReportFormat>(found - kNames.begin());
}

std::span<const std::string_view> report_format_names() { return kNames; }

namespace {

std::unique_ptr<ReportWriter> writer_of(ReportFormat format, const FormatOptions& options) {
  switch (format) {
    case ReportFormat::json:
      return report::make_json_writer(options);
    case ReportFormat::jsonl:
      return report::make_json_lines_writer(options);
    case ReportFormat::khronos:
      return report::make_khronos_writer();
    case ReportFormat::github:
      return report::make_github_writer(options);
    case ReportFormat::gitlab:
      return report::make_gitlab_writer(options);
    case ReportFormat::sarif:
      return report::make_sarif_writer(options);
    case ReportFormat::junit:
      return report::make_junit_writer(options);
    case ReportFormat::agent:
      return report::make_agent_writer(options);
    case ReportFormat::csv:
      return report::make_csv_writer();
    case ReportFormat::text:
      break;
  }
  return report::make_text_writer(options);
}

}  // namespace

std::unique_ptr<ReportWriter> make_report_writer(ReportFormat format,
                                                 const FormatOptions& options) {
  auto writer = writer_of(format, options);
  if (options.min_severity == Severity::hint) return writer;
  return report::with_min_severity(std::move(writer), options.min_severity);
}

}  // namespace gltfx
