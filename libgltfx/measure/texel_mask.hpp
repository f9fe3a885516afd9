// SPDX-License-Identifier: Apache-2.0
/// The texels of an image that triangles cover.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "model/texture.hpp"

namespace gltfx::measure {

/// A point of the plane in texels; the first texel is from 0 to 1.
using TexelPoint = std::array<double, 2>;

/// Finds covered texels for one sampler. Takes memory of one bit for each texel.
class TexelMask {
 public:
  TexelMask(std::uint32_t width, std::uint32_t height, const model::Sampler& sampler);

  /// Marks the texels that the triangle covers by more than 1/256 of a texel, and the one at its
  /// centre. False: out of a budget of work that is linear in texels and triangles; the triangle
  /// may have been left out. Precondition: the points are finite.
  bool cover(const std::array<TexelPoint, 3>& triangle);

  /// What it has taken, in texels: steps, and those that for_each() visits.
  std::uint64_t cost() const {
    const std::uint64_t texels =
        static_cast<std::uint64_t>(width_) * static_cast<std::uint64_t>(height_);
    return static_cast<std::uint64_t>(steps_) + words_.size() + texels - uncovered_;
  }

  /// Calls `use(index)` for each covered texel, in the order of the rows.
  template <class Use>
  void for_each(const Use& use) const {
    for (std::size_t word = 0; word < words_.size(); ++word) {
      for (std::uint64_t bits = words_[word]; bits != 0; bits &= bits - 1) {
        const auto at = static_cast<std::uint64_t>(word) * 64;
        use(at + static_cast<unsigned>(std::countr_zero(bits)));
      }
    }
  }

 private:
  void cover_span(std::int64_t row, std::int64_t begin, std::int64_t end);
  void mark(std::uint64_t row, std::uint64_t begin, std::uint64_t end);

  std::int64_t width_, height_;
  model::Wrap wrap_s_, wrap_t_;
  std::vector<std::uint64_t> words_;
  std::uint64_t uncovered_;  // texels
  std::int64_t steps_ = 0, most_steps_;
};

}  // namespace gltfx::measure
