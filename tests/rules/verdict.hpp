// SPDX-License-Identifier: Apache-2.0
/// Validates a JSON text from outside and returns the verdict as lines, so that a test reads like a
/// table.
#pragma once

#include <gltfx/pipeline.hpp>

#include <string>
#include <vector>

namespace gltfx::test {

/// Findings as "CODE /pointer" in the order of the report ("CODE @offset" on a container), folded
/// ones with " xN". Hints are included when the profile is strict or khronos.
inline std::vector<std::string> verdict(const std::string& asset, const ValidateOptions& options) {
  const FileReport report = validate_bytes(asset, "test", options);
  std::vector<std::string> lines;
  for (const Diagnostic& found : report.diagnostics) {
    std::string line(found.code);
    line += found.offset ? " @" + std::to_string(*found.offset) : " " + found.pointer;
    if (found.count > 1) line += " x" + std::to_string(found.count);
    lines.push_back(std::move(line));
  }
  return lines;
}

inline std::vector<std::string> verdict(const std::string& asset,
                                        Profile profile = Profile::standard) {
  ValidateOptions options;
  options.profile = profile;
  return verdict(asset, options);
}

}  // namespace gltfx::test
