// SPDX-License-Identifier: Apache-2.0
/// validate_buffer: validates standard input, an asset that is not a file, and prints JSON.
/// Exit code 1: the asset has errors.
#include <gltfx/pipeline.hpp>

#include <iostream>
#include <iterator>
#include <string>
#include <utility>

int main() {
  std::string bytes(std::istreambuf_iterator<char>(std::cin), {});

  gltfx::ValidateOptions options;
  options.max_issues = 100;
  // options.root names the folder of external buffers and images; without it none are read.
  const gltfx::FileReport report = gltfx::validate_bytes(std::move(bytes), "upload", options);

  gltfx::FormatOptions format;
  format.profile = "default";
  const auto writer = gltfx::make_report_writer(gltfx::ReportFormat::json, format);
  gltfx::RunSummary summary;
  summary.add(report);
  std::string out;
  writer->begin(out);
  writer->file(report, out);
  writer->end(summary, out);
  std::cout << out;
  return report.readable && report.counts.errors == 0 ? 0 : 1;
}
