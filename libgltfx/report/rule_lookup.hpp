// SPDX-License-Identifier: Apache-2.0
/// The rule of a finding, for formats that print more than the finding.
#pragma once

#include <gltfx/diagnostic.hpp>

#include <algorithm>
#include <span>
#include <string_view>

namespace gltfx::report {

/// The rule with that code, or null. Precondition: `rules` is sorted by code.
inline const RuleDescription* find_rule_in(std::span<const RuleDescription> rules,
                                           std::string_view code) {
  const auto found = std::lower_bound(
      rules.begin(), rules.end(), code,
      [](const RuleDescription& rule, std::string_view wanted) { return rule.code < wanted; });
  return found != rules.end() && found->code == code ? &*found : nullptr;
}

}  // namespace gltfx::report
