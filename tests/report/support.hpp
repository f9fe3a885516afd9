// SPDX-License-Identifier: Apache-2.0
/// Code shared by the tests of the report module: handmade reports.
#pragma once

#include <gltfx/report.hpp>

#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "json/lines.hpp"

namespace gltfx::report::testing {

inline Diagnostic finding(std::string_view code, Severity severity, std::string message,
                          std::string pointer = {}) {
  Diagnostic diagnostic;
  diagnostic.code = code;
  diagnostic.severity = severity;
  diagnostic.message = std::move(message);
  diagnostic.pointer = std::move(pointer);
  return diagnostic;
}

/// Gives the finding the place of the first `marked` in `text`.
inline Diagnostic on(Diagnostic diagnostic, std::string_view text, std::string_view marked,
                     std::uint64_t base = 0) {
  const std::size_t at = text.find(marked);
  EXPECT_NE(at, std::string_view::npos) << marked;
  const Span span{static_cast<std::uint32_t>(at), static_cast<std::uint32_t>(at + marked.size())};
  const json::LineIndex lines(text);
  diagnostic.location = lines.locate(span, base);
  diagnostic.excerpt = lines.excerpt(span);
  return diagnostic;
}

/// Folds `count` findings into one.
inline Diagnostic times(Diagnostic diagnostic, std::uint64_t count, std::string last) {
  diagnostic.count = count;
  diagnostic.last_pointer = std::move(last);
  return diagnostic;
}

/// Folds a repeat into the last finding of a report and keeps it.
inline void keep_repeat(FileReport& report, const Diagnostic& repeat) {
  Repeat kept;
  kept.finding = report.diagnostics.size() - 1;
  kept.message = repeat.message;
  kept.help = repeat.help;
  kept.pointer = repeat.pointer;
  kept.object_name = repeat.object_name;
  kept.location = repeat.location;
  kept.count = repeat.count;
  kept.requirement = repeat.requirement;
  report.repeats.push_back(std::move(kept));
  Diagnostic& first = report.diagnostics.back();
  first.count += repeat.count;
  first.last_pointer = repeat.pointer;
  report.counts.add(first.severity, repeat.count);
}

inline FileReport file(std::string path, std::vector<Diagnostic> diagnostics = {},
                       std::string mime_type = "model/gltf+json") {
  FileReport report;
  report.path = std::move(path);
  report.mime_type = std::move(mime_type);
  report.diagnostics = std::move(diagnostics);
  for (const Diagnostic& d : report.diagnostics) report.counts.add(d.severity, d.count);
  return report;
}

/// A whole run in one format.
inline std::string run(ReportFormat format, const std::vector<FileReport>& reports,
                       const FormatOptions& options = {}) {
  const auto writer = make_report_writer(format, options);
  RunSummary summary;
  std::string out;
  writer->begin(out);
  for (const FileReport& report : reports) {
    writer->file(report, out);
    summary.add(report);
  }
  writer->end(summary, out);
  return out;
}

/// A material with a mistake, as in a file.
inline constexpr std::string_view kLeaf = R"({
  "asset": { "version": "2.0" },
  "materials": [
    {
      "name": "Leaf",
      "pbrMetallicRoughness": {
        "metallicFactor": "0.5",
        "roughnessFactor": 1.75
      }
    }
  ]
}
)";

inline constexpr std::string_view kMetallic = "/materials/0/pbrMetallicRoughness/metallicFactor";
inline constexpr std::string_view kRoughness = "/materials/0/pbrMetallicRoughness/roughnessFactor";

/// An error with everything a finding can have.
inline Diagnostic wrong_type() {
  Diagnostic d =
      on(finding("TYPE_MISMATCH", Severity::error,
                 "'metallicFactor' is a string; a number is expected.", std::string(kMetallic)),
         kLeaf, "\"0.5\"");
  d.help = "write the number without quotes: 0.5";
  d.object_name = "Leaf";
  return times(d, 42, "/materials/44/pbrMetallicRoughness/metallicFactor");
}

inline Diagnostic out_of_range() {
  return on(finding("VALUE_NOT_IN_RANGE", Severity::warning,
                    "'roughnessFactor' is 1.75; 0 to 1 is allowed.", std::string(kRoughness)),
            kLeaf, "1.75");
}

/// Too many triangles, with what was measured.
inline Diagnostic over_budget() {
  CheckedLimit limit{"triangles", "mesh", 1250.0, "max", 1000.0, "", "gltfx.toml:8"};
  Diagnostic d =
      finding("BUDGET_TRIANGLES", Severity::error,
              "The mesh has 1,250 triangles; the limit is 1,000 (gltfx.toml:8).", "/meshes/0");
  d.object_name = "Body";
  d.requirement = std::make_shared<const CheckedLimit>(std::move(limit));
  return d;
}

/// One requirement of each type and verdict.
inline std::vector<Requirement> requirements() {
  const auto make = [](CheckedLimit limit, std::string pointer, Verdict verdict) {
    Requirement requirement;
    static_cast<CheckedLimit&>(requirement) = std::move(limit);
    requirement.pointer = std::move(pointer);
    requirement.verdict = verdict;
    return requirement;
  };
  using Set = std::vector<std::string>;
  const std::string preset = "preset shop/mobile (1.0.0, 2020-10-20)";
  std::vector<Requirement> all;
  all.push_back(make({"triangles", "mesh", 1250.0, "max", 1000.0, "", "gltfx.toml:8"}, "/meshes/0",
                     Verdict::fail));
  all.back().object_name = "Body";
  all.push_back(make({"size-y", "asset", 0.25, "min", 0.01, "m", preset}, "", Verdict::pass));
  all.push_back(
      make({"root-transform", "asset", false, "equal", true, "", preset}, "", Verdict::fail));
  all.back().severity = Severity::warning;
  all.push_back(make({"name", "mesh", "Body", "match", "^SM_", "", "gltfx.toml:20"}, "/meshes/0",
                     Verdict::fail));
  all.push_back(make(
      {"extensions", "asset", Set{"KHR_a", "KHR_b"}, "allow", Set{"KHR_*"}, "", "gltfx.toml:7"}, "",
      Verdict::pass));
  all.push_back(make({"value-max", "image", {}, "max", 243.0, "", preset}, "/images/0",
                     Verdict::not_measured));
  all.push_back(make({"hard-edges", "mesh", {}, "max", 90.0, "", "gltfx.toml:9", "angle 30 deg"},
                     "", Verdict::not_applicable));
  return all;
}

inline Diagnostic bad_chunk() {
  Diagnostic d = finding("GLB_CHUNK_TOO_BIG", Severity::error, "The chunk ends after the file.");
  d.offset = 12;
  return d;
}

/// Every kind of finding, over several files.
inline std::vector<FileReport> sample_run() {
  std::vector<FileReport> reports;
  reports.push_back(file("models/leaf.gltf", {wrong_type(), out_of_range()}));
  reports.push_back(file("clean.gltf"));
  reports.push_back(file("tree.glb", {bad_chunk()}, "model/gltf-binary"));
  reports.push_back(file("gone.gltf", {finding("IO_ERROR", Severity::error, "No such file.")}, ""));
  reports.back().readable = false;
  reports.push_back(file(
      "big.gltf", {finding("UNUSED_OBJECT", Severity::info, "Nothing uses this.", "/nodes/1")}));
  reports.back().truncated = true;
  reports.back().counts.infos = 4;
  reports.back().suppressed = 5;
  reports.back().unverified = 1;
  reports.back().images_wanted = reports.back().images_decoded = 5;
  return reports;
}

}  // namespace gltfx::report::testing
