// SPDX-License-Identifier: Apache-2.0
/// Adaptive sampling: numbers of samples of the pixels of a picture.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "render/integrator.hpp"
#include "render/view.hpp"

namespace gltfx::render {

struct RenderOptions;

/// Sample counts by blocks of pixels.
class SampleMap {
 public:
  /// The same count everywhere.
  explicit SampleMap(std::uint32_t samples) : most_(samples) {}
  /// Estimates the variance from a few samples that do not count otherwise, and allocates
  /// `options.samples` for each pixel in proportion to the standard deviation (Neyman allocation),
  /// which leaves the least error in the whole picture, or with `options.deviation` in all pictures
  /// together. A pixel gets at least a tenth of `options.samples` and at most four times as many.
  /// The same for any number of jobs. With too few samples for an estimate, or where time or noise
  /// ends the rendering, all pixels get the same count.
  SampleMap(const TraceContext& context, const View& view, const RenderOptions& options);

  std::uint32_t samples(std::uint32_t x, std::uint32_t y) const {
    if (counts_.empty()) return most_;
    return counts_[std::size_t{y / kSide} * columns_ + x / kSide];
  }
  /// The greatest count of all pixels.
  std::uint32_t most() const { return most_; }

 private:
  static constexpr std::uint32_t kSide = 4;  // of a block, in pixels

  // Variances of single samples, by block.
  std::vector<float> estimate_variance(const TraceContext& context, const View& view,
                                       const RenderOptions& options) const;
  void blur(std::vector<float>& values) const;
  void allocate(const std::vector<float>& deviations, const RenderOptions& options,
                double least_average);

  std::uint32_t most_;
  std::uint32_t columns_ = 0, rows_ = 0;  // of blocks
  std::vector<std::uint32_t> counts_;     // row by row; empty: the same everywhere
};

}  // namespace gltfx::render
