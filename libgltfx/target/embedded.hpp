// SPDX-License-Identifier: Apache-2.0
/// The files of schema/targets, as the build puts them into the library.
#pragma once

#include <span>
#include <string_view>

namespace gltfx::target {

struct EmbeddedTarget {
  std::string_view name;
  std::string_view text;
};

/// All targets, sorted by name.
std::span<const EmbeddedTarget> embedded_targets();
/// The list of features.
std::string_view embedded_features();

}  // namespace gltfx::target
