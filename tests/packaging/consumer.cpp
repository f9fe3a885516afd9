// SPDX-License-Identifier: Apache-2.0
/// consumer FILE: validates it, pixels and compressed geometry included, as any program may that
/// has gltfx as a library, and has its own extension.
#include <gltfx/pipeline.hpp>
#include <gltfx/schema.hpp>
#include <gltfx/version.hpp>

#include <algorithm>
#include <iostream>
#include <string>
#include <vector>

namespace {

constexpr const char* kGlow = R"({
  "$schema": "https://json-schema.org/draft/2020-12/schema", "$id": "gltfx:ext/ACME_glow",
  "title": "ACME_glow", "description": "Glowing nodes.", "type": "object",
  "properties": { "strength": { "type": "number", "minimum": 0 } },
  "x-gltfx": { "extension": "ACME_glow", "on": ["node"], "status": "vendor" } })";

constexpr const char* kLamp = R"({ "asset": { "version": "2.0" }, "extensionsUsed": ["ACME_glow"],
  "nodes": [{ "extensions": { "ACME_glow": { "strength": -1 } } }],
  "scenes": [{ "nodes": [0] }], "scene": 0 })";

bool has(const gltfx::FileReport& report, std::string_view code) {
  return std::any_of(report.diagnostics.begin(), report.diagnostics.end(),
                     [&](const gltfx::Diagnostic& finding) { return finding.code == code; });
}

// An extension without a built-in schema is checked by the schema of this program.
bool knows_its_own_extension() {
  std::vector<std::string> problems;
  gltfx::ValidateOptions options;
  options.schemas = gltfx::make_schema_set({{"ACME_glow.schema.json", kGlow}}, problems);
  for (const std::string& problem : problems) std::cout << problem << '\n';
  return options.schemas && !has(gltfx::validate_bytes(kLamp, "lamp"), "VALUE_NOT_IN_RANGE") &&
         has(gltfx::validate_bytes(kLamp, "lamp", options), "VALUE_NOT_IN_RANGE") &&
         !gltfx::make_schema_set({{"broken.schema.json", "{"}}, problems) && problems.size() == 1;
}

}  // namespace

int main(int count, char** words) {
  if (count != 2) return 2;
  gltfx::ValidateOptions options;
  options.pixels = gltfx::PixelLevel::all;
  const gltfx::FileReport report = gltfx::validate_file(words[1], options);
  for (const gltfx::Diagnostic& finding : report.diagnostics) {
    std::cout << finding.code << ' ' << finding.pointer << ": " << finding.message << '\n';
  }
  std::cout << "gltfx " << gltfx::version() << ": " << report.counts.errors << " errors in "
            << report.path << '\n';
  // Without the decoders a finding says what was not checked.
  const bool checked = std::none_of(
      report.diagnostics.begin(), report.diagnostics.end(), [](const gltfx::Diagnostic& finding) {
        return finding.code.ends_with("_NOT_CHECKED") || finding.code.ends_with("_NOT_DECODED");
      });
  if (!knows_its_own_extension()) return 3;
  return report.readable && checked && report.counts.errors == 0 ? 0 : 1;
}
