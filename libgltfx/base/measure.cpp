// SPDX-License-Identifier: Apache-2.0
// Names of what describes measures.
#include <gltfx/measure.hpp>

#include <algorithm>

namespace gltfx {
namespace {

template <std::size_t N>
std::string_view name_in(const std::array<std::string_view, N>& names, std::size_t at) {
  return at < N ? names[at] : std::string_view();
}

constexpr std::array<std::string_view, kMeasureScopeCount> kScopes{
    "asset", "scene", "node", "mesh", "primitive", "material", "image", "skin", "animation"};

}  // namespace

std::string_view measure_scope_name(MeasureScope scope) {
  return name_in(kScopes, static_cast<std::size_t>(scope));
}

std::optional<MeasureScope> measure_scope_from_name(std::string_view name) {
  const auto at = std::find(kScopes.begin(), kScopes.end(), name);
  if (at == kScopes.end()) return std::nullopt;
  return static_cast<MeasureScope>(at - kScopes.begin());
}

std::string_view measure_type_name(MeasureType type) {
  constexpr std::array<std::string_view, 4> kNames{"number", "flag", "text", "set"};
  return name_in(kNames, static_cast<std::size_t>(type));
}

std::string_view measure_total_name(MeasureTotal total) {
  constexpr std::array<std::string_view, 5> kNames{"none", "sum", "max", "min", "all"};
  return name_in(kNames, static_cast<std::size_t>(total));
}

std::string_view measure_needs_name(MeasureNeeds needs) {
  constexpr std::array<std::string_view, 3> kNames{"json", "bytes", "pixels"};
  return name_in(kNames, static_cast<std::size_t>(needs));
}

const MeasureColumn* Measurements::find(MeasureScope scope, std::string_view name) const {
  const auto& list = columns[static_cast<std::size_t>(scope)];
  const auto at = std::lower_bound(list.begin(), list.end(), name,
                                   [](const MeasureColumn& column, std::string_view wanted) {
                                     return column.measure->name < wanted;
                                   });
  return at != list.end() && at->measure->name == name ? &*at : nullptr;
}

}  // namespace gltfx
