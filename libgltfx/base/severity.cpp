// SPDX-License-Identifier: Apache-2.0
#include <gltfx/diagnostic.hpp>

#include <array>

namespace gltfx {
namespace {
constexpr std::array<std::string_view, 4> kNames{"error", "warning", "info", "hint"};
}

std::string_view severity_name(Severity severity) {
  return kNames[static_cast<std::size_t>(severity)];
}

std::optional<Severity> severity_from_name(std::string_view name) {
  for (std::size_t i = 0; i < kNames.size(); ++i) {
    if (kNames[i] == name) return static_cast<Severity>(i);
  }
  return std::nullopt;
}

std::string_view fix_name(Fix fix) {
  constexpr std::array<std::string_view, 4> kFixes{"none", "safe", "unsafe", "upgrade"};
  return kFixes[static_cast<std::size_t>(fix)];
}

}  // namespace gltfx
