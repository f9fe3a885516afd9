// SPDX-License-Identifier: Apache-2.0
/// What has been gathered for each pixel.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "bake/integrator.hpp"
#include "bake/scene.hpp"

namespace gltfx::bake {

/// Sums over the samples of one pixel, which is added to by one thread, in the order of samples.
struct PixelSums {
  std::uint32_t samples = 0;
  std::uint32_t rays = 0;
  std::uint32_t material = kNone;  ///< of the first sample that met one
  // Of two halves, even and odd samples:
  std::array<Float3, 2> scattered{};
  std::array<float, 2> shadow{};  ///< luminance that is taken away from what is behind
  float square = 0;               ///< of the luminance of what is scattered
  Float3 direct{}, behind{};      ///< which have no noise
  float alpha = 0;
  Float3 albedo{}, normal{};
  float depth = 0;
  float albedo_square = 0, normal_square = 0, depth_square = 0;  ///< sums of squared lengths
};

class Film {
 public:
  Film(std::uint32_t width, std::uint32_t height)
      : width_(width), height_(height), pixels_(std::size_t{width} * height) {}

  std::uint32_t width() const { return width_; }
  std::uint32_t height() const { return height_; }
  void add(std::size_t pixel, const PathSample& sample);
  const PixelSums& at(std::size_t pixel) const { return pixels_[pixel]; }
  std::size_t size() const { return pixels_.size(); }

  /// Mean radiance, multiplied by alpha where the background is transparent.
  Rgb radiance(std::size_t pixel) const;
  double alpha(std::size_t pixel) const;
  /// Standard error of the mean's luminance.
  double error(std::size_t pixel) const;

 private:
  std::uint32_t width_, height_;
  std::vector<PixelSums> pixels_;
};

}  // namespace gltfx::bake
