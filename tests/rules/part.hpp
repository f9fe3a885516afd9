// SPDX-License-Identifier: Apache-2.0
/// Helpers for tests of a group of codes: an asset from its members, and the findings of some codes
/// only.
#pragma once

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

#include "rules/verdict.hpp"

namespace gltfx::test {

using Lines = std::vector<std::string>;

/// A glTF 2.0 asset with these members.
inline std::string asset(std::string_view members) {
  return R"({"asset": {"version": "2.0"}, )" + std::string(members) + "}";
}

/// The findings whose code begins with one of the prefixes, in the form of verdict().
inline Lines findings(std::string_view members, const std::vector<std::string_view>& prefixes,
                      Profile profile = Profile::standard) {
  Lines lines = verdict(asset(members), profile);
  const auto other = [&](const std::string& line) {
    return std::none_of(prefixes.begin(), prefixes.end(),
                        [&](std::string_view prefix) { return line.starts_with(prefix); });
  };
  lines.erase(std::remove_if(lines.begin(), lines.end(), other), lines.end());
  return lines;
}

}  // namespace gltfx::test
