// SPDX-License-Identifier: Apache-2.0
/// Limit of the memory of an asset. Accessors may share bytes, and sparse ones need none: without a
/// limit a small file could request any amount.
#pragma once

#include <cstdint>

#include "base/checked.hpp"
#include "json/document.hpp"

namespace gltfx::model {

/// Maximum number of objects in all root arrays of an asset with so many bytes of text: a million,
/// and one more for each 32 bytes. Meaningful objects take more bytes, and each costs many times
/// the three bytes of "{},".
constexpr std::uint64_t most_root_objects(std::uint64_t text_bytes) {
  return 1'000'000 + text_bytes / 32;
}

/// Elements of the arrays that are members of the root.
std::uint64_t root_objects(const json::Document& document);

class MemoryBudget {
 public:
  explicit MemoryBudget(std::uint64_t bytes) : left_(bytes) {}

  /// Takes that many bytes. False, and nothing taken, when fewer are left (or beyond 64 bits).
  bool take(const Checked& bytes) {
    if (!bytes || *bytes > left_) return false;
    left_ -= *bytes;
    return true;
  }

 private:
  std::uint64_t left_;
};

}  // namespace gltfx::model
