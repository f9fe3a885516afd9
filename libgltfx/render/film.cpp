// SPDX-License-Identifier: Apache-2.0
#include "render/film.hpp"

#include <algorithm>
#include <cmath>

#include "base/packed.hpp"

namespace gltfx::render {
namespace {

void add_to(Float3& sum, const Vec3d& value) {
  sum[0] += static_cast<float>(value.x);
  sum[1] += static_cast<float>(value.y);
  sum[2] += static_cast<float>(value.z);
}

float squared(double value) { return static_cast<float>(value * value); }

Rgb noisy(const PixelSums& sums) {
  return to_vec(sums.light.reflected[0]) + to_vec(sums.light.reflected[1]) +
         to_vec(sums.light.scattered[0]) + to_vec(sums.light.scattered[1]);
}

double shadow(const PixelSums& sums) {
  return static_cast<double>(sums.light.shadow[0]) + static_cast<double>(sums.light.shadow[1]);
}

// The standard error of a mean, by the sums of luminances and of their squares.
double standard_error(std::uint32_t samples, double sum, float square) {
  if (samples < 2) return 0;
  const double count = samples;
  const double mean = sum / count;
  const double variance = static_cast<double>(square) / count - mean * mean;
  return std::sqrt(std::max(variance, 0.0) / (count - 1));
}

bool is_finite(const Rgb& c) { return std::isfinite(c.x + c.y + c.z); }

}  // namespace

void FeatureSums::add(const PathSample& sample) {
  ++count;
  add_to(emitted, sample.emitted);
  add_to(background, sample.background);
  alpha += static_cast<float>(sample.alpha);
  add_to(albedo, sample.features.albedo);
  add_to(specular_albedo, sample.features.specular_albedo);
  add_to(normal, sample.features.normal);
  depth += static_cast<float>(sample.features.depth);
}

void PixelSums::add_features(const PathSample& sample) {
  features.add(sample);
  albedo_square += static_cast<float>(dot(sample.features.albedo, sample.features.albedo));
  normal_square += static_cast<float>(dot(sample.features.normal, sample.features.normal));
  clear = clear || sample.features.clear;
  if (material == kNone) material = sample.features.material;
}

FeatureVariance PixelSums::feature_variance() const {
  if (clear || features.alpha <= 0) return {};
  const double count = features.count;
  const auto variance = [count](float squares, const Float3& sum) {
    const Vec3d mean = to_vec(sum) / count;
    return std::max(static_cast<double>(squares) / count - dot(mean, mean), 0.0);
  };
  const double covered = static_cast<double>(features.alpha) / count;
  return {covered * (1 - covered), variance(albedo_square, features.albedo),
          variance(normal_square, features.normal)};
}

void Film::reserve(std::uint32_t rows) {
  pixels_.reserve(std::size_t{rows} * width_);
  feature_samples_.reserve(std::size_t{rows} * width_);
}

void Film::hold(const Rows& rows) {
  const std::size_t lost = std::min(std::size_t{rows.first - held_.first} * width_, size());
  pixels_.erase(pixels_.begin(), pixels_.begin() + static_cast<std::ptrdiff_t>(lost));
  for (std::size_t i = 0; i < lost; ++i) {
    if (feature_samples_[i] != kNone) unused_.push_back(feature_samples_[i]);
  }
  feature_samples_.erase(feature_samples_.begin(),
                         feature_samples_.begin() + static_cast<std::ptrdiff_t>(lost));
  held_ = rows;
  pixels_.resize(std::size_t{rows.last - rows.first} * width_);
  feature_samples_.resize(pixels_.size(), kNone);
}

void Film::add(std::size_t pixel, const PathSample& sample) {
  PixelSums& sums = pixels_[pixel - first_pixel()];
  const std::size_t half = sums.samples & 1U;
  ++sums.samples;
  sums.rays += sample.rays;
  if (!is_finite(sample.radiance())) {
    ++sums.features.count;
    return;
  }
  add_to(sums.light.reflected[half], sample.reflected);
  add_to(sums.light.scattered[half], sample.scattered);
  const double taken = luminance(sample.background) * sample.shadow;
  sums.light.shadow[half] += static_cast<float>(taken);
  const double reflected = luminance(sample.reflected);
  const double scattered = luminance(sample.scattered);
  sums.light.square += squared(reflected + scattered - taken);
  sums.light.reflected_square += squared(reflected);
  sums.light.scattered_square += squared(scattered);
  sums.add_features(sample);
  if (half == 1) add_to(sums.odd_albedo, sample.features.albedo);
}

void Film::set_features(std::size_t pixel, const FeatureSums& sums, std::uint32_t material) {
  const std::size_t held = pixel - first_pixel();
  pixels_[held].material = material;
  std::uint32_t& place = feature_samples_[held];
  if (unused_.empty()) {
    place = static_cast<std::uint32_t>(feature_sums_.size());
    feature_sums_.push_back(sums);
  } else {
    place = unused_.back();
    unused_.pop_back();
    feature_sums_[place] = sums;
  }
}

const FeatureSums& Film::features(std::size_t pixel) const {
  const std::uint32_t all = feature_samples_[pixel - first_pixel()];
  return all == kNone ? at(pixel).features : feature_sums_[all];
}

Rgb Film::radiance(std::size_t pixel) const {
  const PixelSums& sums = at(pixel);
  if (sums.samples == 0) return {};
  const Rgb behind = to_vec(sums.features.background);
  const double seen = luminance(behind);
  const double lit = seen > 0 ? 1 - shadow(sums) / seen : 1;
  return (noisy(sums) + to_vec(sums.features.emitted) + behind * lit) /
         static_cast<double>(sums.samples);
}

double Film::error(std::size_t pixel) const {
  const PixelSums& sums = at(pixel);
  return standard_error(sums.samples, luminance(noisy(sums)) - shadow(sums), sums.light.square);
}

double Film::error(std::size_t pixel, LightPart part) const {
  const PixelSums& sums = at(pixel);
  const bool scattered = part == LightPart::scattered;
  const auto& halves = scattered ? sums.light.scattered : sums.light.reflected;
  return standard_error(sums.samples, luminance(to_vec(halves[0]) + to_vec(halves[1])),
                        scattered ? sums.light.scattered_square : sums.light.reflected_square);
}

}  // namespace gltfx::render
