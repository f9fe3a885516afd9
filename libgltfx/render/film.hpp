// SPDX-License-Identifier: Apache-2.0
/// Sums of samples by pixel.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <vector>

#include "render/integrator.hpp"
#include "render/scene.hpp"

namespace gltfx::render {

/// Sums of features, and of light without noise.
struct FeatureSums {
  std::uint32_t count = 0;
  Float3 emitted{}, background{};
  float alpha = 0;
  Float3 albedo{}, specular_albedo{}, normal{};
  float depth = 0;

  void add(const PathSample& sample);
};

/// Sums of light with noise: even and odd samples separately, as independent estimates.
struct LightSums {
  std::array<Float3, 2> reflected{}, scattered{};
  std::array<float, 2> shadow{};  ///< luminance that shadow takes away
  // Sums of squared luminances, of all light with noise and of its parts:
  float square = 0, reflected_square = 0, scattered_square = 0;
};

/// Variances of the features of single samples; of vectors, sums over their components.
struct FeatureVariance {
  double alpha = 0, albedo = 0, normal = 0;
};

/// Sums over the samples of one pixel. One thread adds to it, in the order of samples.
struct PixelSums {
  std::uint32_t samples = 0;
  std::uint32_t rays = 0;
  std::uint32_t material = kNone;  ///< of the first sample that hit one
  bool clear = false;              ///< whether something is or may be seen through glass
  LightSums light;
  FeatureSums features;
  float albedo_square = 0, normal_square = 0;  ///< sums of squared lengths
  Float3 odd_albedo{};                         ///< sum over the odd samples

  /// Adds the features of a sample only.
  void add_features(const PathSample& sample);
  /// 0 where the subject is not seen, or through glass, where features have noise.
  FeatureVariance feature_variance() const;
};

/// Parts of the light that have noise.
enum class LightPart : std::uint8_t { scattered, reflected };

/// Rows of a picture, from the top: [first, last).
struct Rows {
  std::uint32_t first = 0, last = 0;
};

/// Sums of the rows of a picture that are rendered at a time. Pixels are numbered row by row
/// through the whole picture, independent of the rows that are held.
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
  /// Reserves memory for the number of rows that will be held at a time.
  void reserve(std::uint32_t rows);
  /// Rows that are no longer held are lost; new ones are empty. Neither end moves up.
  void hold(const Rows& rows);

  void add(std::size_t pixel, const PathSample& sample);
  const PixelSums& at(std::size_t pixel) const { return pixels_[pixel - first_pixel()]; }

  /// Sets the features of all samples of a pixel, feature samples among them, once at most;
  /// `material`: the first one that any sample met.
  void set_features(std::size_t pixel, const FeatureSums& sums, std::uint32_t material);
  /// Features of samples and feature samples.
  const FeatureSums& features(std::size_t pixel) const;
  /// The number of pixels that are held, and the first one of them.
  std::size_t size() const { return pixels_.size(); }
  std::size_t first_pixel() const { return std::size_t{held_.first} * width_; }

  /// Mean radiance, multiplied by alpha where the background is transparent.
  Rgb radiance(std::size_t pixel) const;
  /// Standard error of the mean's luminance.
  double error(std::size_t pixel) const;
  /// Standard error of the luminance of one part.
  double error(std::size_t pixel, LightPart part) const;

 private:
  std::uint32_t width_, height_;
  Rows held_;
  // Of the rows that are held:
  std::vector<PixelSums> pixels_;
  std::vector<std::uint32_t> feature_samples_;  ///< by pixel: index in feature_sums_, or kNone
  std::deque<FeatureSums> feature_sums_;        ///< grows without being copied
  std::vector<std::uint32_t> unused_;  ///< indices in feature_sums_ of pixels that were dropped
};

}  // namespace gltfx::render
