// SPDX-License-Identifier: Apache-2.0
#include "bake/bvh_repeats.hpp"

#include <algorithm>
#include <bit>
#include <cstddef>

#include "bake/sampler.hpp"

namespace gltfx::bake {
namespace {

constexpr std::size_t kRepeatProbes = 4096;

using Triangle = std::array<std::uint32_t, 3>;
using CornerPoints = std::array<Float3, 3>;

std::uint32_t hash_of(const CornerPoints& corners) {
  std::uint32_t hash = 0;
  for (const Float3& corner : corners) {
    for (const float value : corner) hash = mix_bits(hash, std::bit_cast<std::uint32_t>(value));
  }
  return hash;
}

/// A set of triangles by their corners. Open addressing.
class Kinds {
 public:
  Kinds(std::span<const Triangle> triangles, std::span<const Float3> points, std::size_t count)
      : triangles_(triangles), points_(points), slots_(std::bit_ceil(2 * count + 1), kNone) {}

  /// False if the set has an equal triangle.
  bool add(std::uint32_t number) {
    const CornerPoints corners = corners_of(number);
    const std::size_t mask = slots_.size() - 1;
    for (std::size_t at = hash_of(corners) & mask;; at = (at + 1) & mask) {
      std::uint32_t& slot = slots_[at];
      if (slot == kNone) {
        slot = number;
        return true;
      }
      if (corners_of(slot) == corners) return false;
    }
  }

 private:
  CornerPoints corners_of(std::uint32_t number) const {
    const Triangle& t = triangles_[number];
    return {points_[t[0]], points_[t[1]], points_[t[2]]};
  }

  std::span<const Triangle> triangles_;
  std::span<const Float3> points_;
  std::vector<std::uint32_t> slots_;
};

bool may_repeat(std::span<const Triangle> triangles, std::span<const Float3> points) {
  const std::size_t count = std::min(kRepeatProbes, triangles.size());
  Kinds kinds(triangles, points, count);
  for (std::size_t i = 0; i < count; ++i) {
    if (!kinds.add(static_cast<std::uint32_t>(i * triangles.size() / count))) return true;
  }
  return false;
}

}  // namespace

std::vector<std::uint32_t> find_repeats(std::span<const Triangle> triangles,
                                        std::span<const Float3> points) {
  std::vector<std::uint32_t> repeats;
  if (!may_repeat(triangles, points)) return repeats;
  Kinds kinds(triangles, points, triangles.size());
  for (std::uint32_t i = 0; i < triangles.size(); ++i) {
    if (!kinds.add(i)) repeats.push_back(i);
  }
  return repeats;
}

}  // namespace gltfx::bake
