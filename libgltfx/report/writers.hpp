// SPDX-License-Identifier: Apache-2.0
/// One factory per format; make_report_writer chooses.
#pragma once

#include <gltfx/report.hpp>

#include <memory>

namespace gltfx::report {

std::unique_ptr<ReportWriter> make_text_writer(const FormatOptions& options);
/// The layouts of the text format that need all reports before they write.
std::unique_ptr<ReportWriter> make_grouped_writer(const FormatOptions& options);
std::unique_ptr<ReportWriter> make_statistics_writer(const FormatOptions& options);
std::unique_ptr<ReportWriter> make_json_writer(const FormatOptions& options);
std::unique_ptr<ReportWriter> make_json_lines_writer(const FormatOptions& options);
/// Keeps the text of the first file until a second file or the end decides the structure.
std::unique_ptr<ReportWriter> make_khronos_writer();
std::unique_ptr<ReportWriter> make_github_writer(const FormatOptions& options);
std::unique_ptr<ReportWriter> make_gitlab_writer(const FormatOptions& options);
std::unique_ptr<ReportWriter> make_sarif_writer(const FormatOptions& options);
std::unique_ptr<ReportWriter> make_junit_writer(const FormatOptions& options);
std::unique_ptr<ReportWriter> make_agent_writer(const FormatOptions& options);
std::unique_ptr<ReportWriter> make_csv_writer();

/// Hands reports on without findings below `least`; the counts stay.
std::unique_ptr<ReportWriter> with_min_severity(std::unique_ptr<ReportWriter> writer,
                                                Severity least);

}  // namespace gltfx::report
