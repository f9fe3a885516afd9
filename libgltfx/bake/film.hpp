// SPDX-License-Identifier: Apache-2.0
/// What has been gathered for each pixel.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <vector>

#include "bake/integrator.hpp"
#include "bake/scene.hpp"

namespace gltfx::bake {

/// Sums of what is seen first.
struct FeatureSums {
  std::uint32_t count = 0;
  Float3 emitted{}, background{};  ///< light that has no noise
  float alpha = 0;
  Float3 albedo{}, specular_albedo{}, normal{};
  float depth = 0;
};

/// Sums over the samples of one pixel, which is added to by one thread, in the order of samples.
struct PixelSums {
  std::uint32_t samples = 0;
  std::uint32_t rays = 0;
  std::uint32_t material = kNone;  ///< of the first sample that met one
  bool clear = false;              ///< whether something is or may be seen through glass
  // Of two halves, even and odd samples:
  std::array<Float3, 2> reflected{}, scattered{};
  std::array<float, 2> shadow{};                     ///< luminance that it takes away
  float square = 0;                                  ///< of the luminance of all that has noise
  float reflected_square = 0, scattered_square = 0;  ///< and of either
  FeatureSums feature_sums;
  float albedo_square = 0, normal_square = 0;  ///< sums of squared lengths

  /// Whether samples saw different things, so that looks tell more.
  bool is_mixed() const;
};

/// What noise is in.
enum class LightPart : std::uint8_t { scattered, reflected };

/// Rows of a picture, from the top: [first, last).
struct Rows {
  std::uint32_t first = 0, last = 0;
};

/// Pixels count through the whole picture, row by row, whichever rows are held.
class Film {
 public:
  /// Holds all rows.
  Film(std::uint32_t width, std::uint32_t height) : Film(width, height, {0, height}) {}
  Film(std::uint32_t width, std::uint32_t height, const Rows& held)
      : width_(width), height_(height) {
    hold(held);
  }

  std::uint32_t width() const { return width_; }
  std::uint32_t height() const { return height_; }
  const Rows& held() const { return held_; }
  /// Makes room for as many rows as are going to be held at a time.
  void reserve(std::uint32_t rows);
  /// Rows that are held no longer are lost; new ones are empty. Neither end moves up.
  void hold(const Rows& rows);

  void add(std::size_t pixel, const PathSample& sample);
  const PixelSums& at(std::size_t pixel) const { return pixels_[pixel - first_pixel()]; }

  /// More of what is seen at a pixel, and the first material that was.
  void add_sights(std::size_t pixel, const FeatureSums& feature_sums, std::uint32_t material);
  /// What was seen by samples and looks.
  FeatureSums feature_sums(std::size_t pixel) const;
  /// Pixels that are held, and the first one of them.
  std::size_t size() const { return pixels_.size(); }
  std::size_t first_pixel() const { return std::size_t{held_.first} * width_; }

  /// Mean radiance, multiplied by alpha where the background is transparent.
  Rgb radiance(std::size_t pixel) const;
  /// Standard error of the mean's luminance.
  double error(std::size_t pixel) const;
  /// That of one part.
  double error(std::size_t pixel, LightPart part) const;

 private:
  std::uint32_t width_, height_;
  Rows held_;
  // Of the rows that are held:
  std::vector<PixelSums> pixels_;
  std::vector<std::uint32_t> looked_;  ///< by pixel, index in looks_ or kNone
  std::deque<FeatureSums> looks_;      ///< grows without being copied
  std::vector<std::uint32_t> unused_;  ///< places in it, of pixels that are held no longer
};

/// One more.
void add(FeatureSums& feature_sums, const PathSample& sample);
/// One more, of which only what it saw counts.
void add_sight(PixelSums& sums, const PathSample& sample);

}  // namespace gltfx::bake
