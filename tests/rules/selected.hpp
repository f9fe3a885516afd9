// SPDX-License-Identifier: Apache-2.0
/// Verdicts restricted to the codes of a test.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "verdict.hpp"

namespace gltfx::test {

using Lines = std::vector<std::string>;

/// Findings with one of `codes` as "CODE /pointer". The profile is khronos if repeats must not be
/// folded, and strict if hints are needed.
inline Lines selected(const std::string& asset, std::set<std::string, std::less<>> codes,
                      Profile profile = Profile::standard) {
  ValidateOptions options;
  options.profile = profile;
  options.select = std::move(codes);
  return verdict(asset, options);
}

/// Pointers of the findings with that code, in the order of the report.
inline Lines places(const std::string& asset, const std::string& code,
                    Profile profile = Profile::standard) {
  Lines lines = selected(asset, {code}, profile);
  for (std::string& line : lines) line.erase(0, code.size() + 1);
  return lines;
}

/// The message of the first finding with that code, or empty.
inline std::string message(const std::string& asset, const std::string& code,
                           Profile profile = Profile::standard) {
  ValidateOptions options;
  options.profile = profile;
  options.select = {code};
  const FileReport report = validate_bytes(asset, "test", options);
  return report.diagnostics.empty() ? std::string() : report.diagnostics.front().message;
}

/// The help of the first finding with that code, or empty.
inline std::string help(const std::string& asset, const std::string& code,
                        Profile profile = Profile::standard) {
  ValidateOptions options;
  options.profile = profile;
  options.select = {code};
  const FileReport report = validate_bytes(asset, "test", options);
  return report.diagnostics.empty() ? std::string() : report.diagnostics.front().help;
}

/// An asset with these members in addition to `asset`: R"("meshes": [])".
inline std::string asset_with(const std::string& members) {
  return R"({"asset": {"version": "2.0"}, )" + members + "}";
}

}  // namespace gltfx::test
