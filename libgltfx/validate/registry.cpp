// SPDX-License-Identifier: Apache-2.0
// Every rule of every family, sorted by code: what `explain`, `rules` and the collector look things
// up in.
#include <algorithm>
#include <array>
#include <vector>

#include "validate/context.hpp"

namespace gltfx {

std::span<const RuleDescription> rules() {
  static const std::vector<RuleDescription> sorted = [] {
    std::vector<RuleDescription> all;
    for (const validate::Family& family : validate::families()) {
      all.insert(all.end(), family.rules.begin(), family.rules.end());
    }
    std::sort(all.begin(), all.end(),
              [](const RuleDescription& a, const RuleDescription& b) { return a.code < b.code; });
    return all;
  }();
  return sorted;
}

std::string_view pixel_level_name(PixelLevel level) {
  constexpr std::array<std::string_view, 3> kNames{"headers", "needed", "all"};
  return kNames[static_cast<std::size_t>(level)];
}

PixelLevel pixel_level(const ValidateOptions& options) {
  if (options.profile == Profile::khronos) return PixelLevel::headers;
  const bool strict = options.profile == Profile::strict;
  return options.pixels.value_or(strict ? PixelLevel::needed : PixelLevel::headers);
}

const RuleDescription* find_rule(std::string_view code) {
  const auto all = rules();
  const auto at = std::lower_bound(
      all.begin(), all.end(), code,
      [](const RuleDescription& rule, std::string_view wanted) { return rule.code < wanted; });
  return at != all.end() && at->code == code ? &*at : nullptr;
}

}  // namespace gltfx
