// SPDX-License-Identifier: Apache-2.0
/// consumer FILE: validates it, pixels and compressed geometry included, as any program may that
/// has gltfx as a library.
#include <gltfx/pipeline.hpp>
#include <gltfx/version.hpp>

#include <algorithm>
#include <iostream>
#include <string>

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
  // Without the decoders a finding says what was not looked into.
  const bool checked = std::none_of(
      report.diagnostics.begin(), report.diagnostics.end(),
      [](const gltfx::Diagnostic& finding) { return finding.code.ends_with("_NOT_CHECKED"); });
  return report.readable && checked && report.counts.errors == 0 ? 0 : 1;
}
