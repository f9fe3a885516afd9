// SPDX-License-Identifier: Apache-2.0
/// Groups of things that are joined pair by pair.
#pragma once

#include <cstddef>
#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

namespace gltfx {

/// Each thing begins as a group of its own. A call takes a logarithm of the number of things.
class DisjointSets {
 public:
  explicit DisjointSets(std::size_t count = 0) : parents_(count) {
    std::iota(parents_.begin(), parents_.end(), 0U);
  }

  /// Adds a thing and returns its number, that of the things before.
  std::uint32_t add() {
    parents_.push_back(static_cast<std::uint32_t>(parents_.size()));
    return parents_.back();
  }

  /// The least thing of the group.
  std::uint32_t find(std::uint32_t thing) {
    while (parents_[thing] != thing) {
      parents_[thing] = parents_[parents_[thing]];
      thing = parents_[thing];
    }
    return thing;
  }

  /// Makes one group of two. False: they are one already.
  bool join(std::uint32_t a, std::uint32_t b) {
    a = find(a);
    b = find(b);
    if (a == b) return false;
    if (b < a) std::swap(a, b);
    parents_[b] = a;
    return true;
  }

 private:
  std::vector<std::uint32_t> parents_;
};

}  // namespace gltfx
