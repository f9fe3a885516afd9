// SPDX-License-Identifier: Apache-2.0
#include <gltfx/report.hpp>

#include <algorithm>
#include <array>

namespace gltfx {
namespace {

constexpr std::array<std::string_view, 4> kVerdicts{"pass", "fail", "not-measured",
                                                    "not-applicable"};

}  // namespace

std::string_view verdict_name(Verdict verdict) {
  return kVerdicts[static_cast<std::size_t>(verdict)];
}

std::optional<Verdict> verdict_from_name(std::string_view name) {
  const auto found = std::find(kVerdicts.begin(), kVerdicts.end(), name);
  if (found == kVerdicts.end()) return std::nullopt;
  return static_cast<Verdict>(found - kVerdicts.begin());
}

}  // namespace gltfx
