// SPDX-License-Identifier: Apache-2.0
/// Properties whose values change while an asset is shown.
#pragma once

#include <string>
#include <vector>

#include "rules/context.hpp"

namespace gltfx::validate {

/// The properties with values that may change. Made once for an asset.
class Animated {
 public:
  explicit Animated(const Context& context);
  /// Whether the property at that pointer may change.
  bool contains(const std::string& pointer) const;

 private:
  std::vector<std::string> pointers_;  // sorted
  bool any_ = false;
};

}  // namespace gltfx::validate
