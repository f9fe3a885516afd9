// SPDX-License-Identifier: Apache-2.0
/// Properties that get other values while an asset is shown.
#pragma once

#include <string>
#include <vector>

#include "rules/context.hpp"

namespace gltfx::validate {

/// Whether a value that is written is the only one a property will have. Made once for an asset.
class Animated {
 public:
  explicit Animated(const Context& context);
  /// Whether the property at that pointer may get another value.
  bool contains(const std::string& pointer) const;

 private:
  std::vector<std::string> pointers_;  // sorted
  bool any_ = false;
};

}  // namespace gltfx::validate
