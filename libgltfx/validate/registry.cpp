// SPDX-License-Identifier: Apache-2.0
// Rules by code and by name, and families in order.
#include <algorithm>
#include <array>
#include <vector>

#include "validate/context.hpp"

namespace gltfx {

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

namespace validate {

std::span<const Family> families() {
  static const std::vector<Family> sorted = [] {
    std::vector<Family> all = all_families();
    std::sort(all.begin(), all.end(),
              [](const Family& a, const Family& b) { return a.order < b.order; });
    return all;
  }();
  return sorted;
}

const RuleDescription& description(Code code) { return rules()[static_cast<std::size_t>(code)]; }

}  // namespace validate

}  // namespace gltfx
