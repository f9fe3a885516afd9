// SPDX-License-Identifier: Apache-2.0
/// How much memory an asset may take. Accessors may share bytes, and sparse ones need none: without
/// a limit a small file could ask for any amount.
#pragma once

#include <cstdint>

#include "base/checked.hpp"

namespace gltfx::model {

class MemoryBudget {
 public:
  explicit MemoryBudget(std::uint64_t bytes) : left_(bytes) {}

  /// Takes that many bytes, or nothing when they are not left (or beyond 64 bits).
  bool take(const Checked& bytes) {
    if (!bytes || *bytes > left_) return false;
    left_ -= *bytes;
    return true;
  }

 private:
  std::uint64_t left_;
};

}  // namespace gltfx::model
