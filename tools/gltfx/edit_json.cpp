// SPDX-License-Identifier: Apache-2.0
#include "edit_json.hpp"

#include <gltfx/version.hpp>

namespace gltfx::tool {

std::string edit_json_begin() {
  std::string out = R"({"gltfx":)";
  json::append_string(out, version());
  return out + R"(,"format":1,"files":[)";
}

void write_outcome(json::Writer& writer, const EditOutcome& report) {
  writer.member("path", report.path);
  writer.member("problem", edit_problem_name(report.problem));
  if (!report.error.empty()) writer.member("error", report::long_value(report.error));
  writer.member("changes", report.changes);
  writer.member("written", report.written);
}

void write_place(json::Writer& writer, const EditOutcome& report) {
  if (!report.written_to.empty()) writer.member("writtenTo", report.written_to);
  if (!report.external_assets.empty()) {
    report::write_long_values(writer, "externalAssets", report.external_assets);
  }
}

std::string edit_json_end(const std::vector<std::pair<std::string_view, std::uint64_t>>& totals) {
  std::string out = "\n],\"summary\":";
  json::Writer writer(out);
  writer.begin_object();
  for (const auto& [name, total] : totals) writer.member(name, total);
  writer.end_object();
  return out + "}\n";
}

}  // namespace gltfx::tool
