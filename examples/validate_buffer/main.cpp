// SPDX-License-Identifier: Apache-2.0
/// validate_buffer [URI=FILE...]: validates standard input, an asset that is not a file, and prints
/// JSON. Each FILE holds the bytes of the asset's URI, as in an upload of several files. Exit code
/// 1: the asset has errors.
#include <gltfx/pipeline.hpp>

#include <fstream>
#include <iostream>
#include <iterator>
#include <map>
#include <optional>
#include <string>

namespace {

std::string rest_of(std::istream& stream) {
  return std::string(std::istreambuf_iterator<char>(stream), {});
}

std::map<std::string, std::string> resources_of(int argc, char** argv) {
  std::map<std::string, std::string> resources;
  for (int i = 1; i < argc; ++i) {
    const std::string argument = argv[i];
    const std::size_t equals = argument.find('=');
    if (equals == std::string::npos) continue;
    std::ifstream file(argument.substr(equals + 1), std::ios::binary);
    resources[argument.substr(0, equals)] = rest_of(file);
  }
  return resources;
}

}  // namespace

int main(int argc, char** argv) {
  const auto resources = resources_of(argc, argv);
  gltfx::MemoryAsset asset;
  asset.bytes = rest_of(std::cin);
  asset.name = "upload";
  // Nothing is read from the disk: the function decides what there is.
  asset.read = [&](const std::string& uri) -> std::optional<std::string> {
    const auto found = resources.find(uri);
    if (found == resources.end()) return std::nullopt;
    return found->second;
  };

  gltfx::ValidateOptions options;
  options.max_issues = 100;
  const gltfx::FileReport report = gltfx::validate_bytes(asset, options);

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
