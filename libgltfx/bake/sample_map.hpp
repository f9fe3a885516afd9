// SPDX-License-Identifier: Apache-2.0
/// How many samples the pixels of a picture get: more where noise is.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "bake/integrator.hpp"
#include "bake/view.hpp"

namespace gltfx::bake {

struct RenderOptions;

/// Numbers of samples, by squares of pixels.
class SampleMap {
 public:
  /// The same number everywhere.
  explicit SampleMap(std::uint32_t samples) : most_(samples) {}
  /// Finds out with few samples besides where noise is, and shares out `options.samples` for each
  /// pixel in proportion to it, which leaves the least of it as a whole: no pixel gets less than a
  /// quarter of that or more than four times as much. The same for any number of jobs. Where there
  /// are too few to find out, or an end by time or noise is wanted, all pixels get the same.
  SampleMap(const TraceContext& context, const View& view, const RenderOptions& options);

  std::uint32_t samples(std::uint32_t x, std::uint32_t y) const {
    if (counts_.empty()) return most_;
    return counts_[std::size_t{y / kSide} * columns_ + x / kSide];
  }
  /// Of any pixel.
  std::uint32_t most() const { return most_; }

 private:
  static constexpr std::uint32_t kSide = 4;  // of a square, in pixels

  // Variances of single samples, by square.
  std::vector<float> find_noise(const TraceContext& context, const View& view,
                                const RenderOptions& options) const;
  void blur(std::vector<float>& values) const;
  void share_out(const std::vector<float>& noise, const RenderOptions& options);

  std::uint32_t most_;
  std::uint32_t columns_ = 0, rows_ = 0;  // of squares
  std::vector<std::uint32_t> counts_;     // row by row; empty: the same everywhere
};

}  // namespace gltfx::bake
