// SPDX-License-Identifier: Apache-2.0
#include "bake/film.hpp"

#include <algorithm>
#include <cmath>

#include "bake/storage.hpp"

namespace gltfx::bake {
namespace {

void add_to(Float3& sum, const Vec3d& value) {
  sum[0] += static_cast<float>(value.x);
  sum[1] += static_cast<float>(value.y);
  sum[2] += static_cast<float>(value.z);
}

float squared(double value) { return static_cast<float>(value * value); }

Rgb noisy(const PixelSums& sums) {
  return to_vec(sums.reflected[0]) + to_vec(sums.reflected[1]) + to_vec(sums.scattered[0]) +
         to_vec(sums.scattered[1]);
}

double shadow(const PixelSums& sums) {
  return static_cast<double>(sums.shadow[0]) + static_cast<double>(sums.shadow[1]);
}

// Of the mean, by the sum of luminances and of their squares.
double standard_error(std::uint32_t samples, double sum, float square) {
  if (samples < 2) return 0;
  const double count = samples;
  const double mean = sum / count;
  const double variance = static_cast<double>(square) / count - mean * mean;
  return std::sqrt(std::max(variance, 0.0) / (count - 1));
}

bool is_finite(const Rgb& c) { return std::isfinite(c.x + c.y + c.z); }

}  // namespace

void add(FeatureSums& feature_sums, const PathSample& sample) {
  ++feature_sums.count;
  add_to(feature_sums.emitted, sample.emitted);
  add_to(feature_sums.background, sample.background);
  feature_sums.alpha += static_cast<float>(sample.alpha);
  add_to(feature_sums.albedo, sample.features.albedo);
  add_to(feature_sums.specular_albedo, sample.features.specular_albedo);
  add_to(feature_sums.normal, sample.features.normal);
  feature_sums.depth += static_cast<float>(sample.features.depth);
}

void add_sight(PixelSums& sums, const PathSample& sample) {
  add(sums.feature_sums, sample);
  sums.albedo_square += static_cast<float>(dot(sample.features.albedo, sample.features.albedo));
  sums.normal_square += static_cast<float>(dot(sample.features.normal, sample.features.normal));
  sums.clear = sums.clear || sample.features.clear;
  if (sums.material == kNone) sums.material = sample.features.material;
}

bool PixelSums::is_mixed() const {
  constexpr double kColors = 3e-4;  // variances
  constexpr double kNormals = 1e-2;
  if (clear || feature_sums.alpha <= 0) return false;
  const double count = feature_sums.count;
  if (static_cast<double>(feature_sums.alpha) < count * (1 - 1e-4)) return true;
  const auto spread = [count](float squares, const Float3& sum) {
    const Vec3d mean = to_vec(sum) / count;
    return static_cast<double>(squares) / count - dot(mean, mean);
  };
  return spread(albedo_square, feature_sums.albedo) > kColors ||
         spread(normal_square, feature_sums.normal) > kNormals;
}

void Film::reserve(std::uint32_t rows) {
  pixels_.reserve(std::size_t{rows} * width_);
  looked_.reserve(std::size_t{rows} * width_);
}

void Film::hold(const Rows& rows) {
  const std::size_t lost = std::min(std::size_t{rows.first - held_.first} * width_, size());
  pixels_.erase(pixels_.begin(), pixels_.begin() + static_cast<std::ptrdiff_t>(lost));
  for (std::size_t i = 0; i < lost; ++i) {
    if (looked_[i] != kNone) unused_.push_back(looked_[i]);
  }
  looked_.erase(looked_.begin(), looked_.begin() + static_cast<std::ptrdiff_t>(lost));
  held_ = rows;
  pixels_.resize(std::size_t{rows.last - rows.first} * width_);
  looked_.resize(pixels_.size(), kNone);
}

void Film::add(std::size_t pixel, const PathSample& sample) {
  PixelSums& sums = pixels_[pixel - first_pixel()];
  const std::size_t half = sums.samples & 1U;
  ++sums.samples;
  sums.rays += sample.rays;
  if (!is_finite(sample.radiance())) {
    ++sums.feature_sums.count;
    return;
  }
  add_to(sums.reflected[half], sample.reflected);
  add_to(sums.scattered[half], sample.scattered);
  const double taken = luminance(sample.background) * sample.shadow;
  sums.shadow[half] += static_cast<float>(taken);
  const double reflected = luminance(sample.reflected);
  const double scattered = luminance(sample.scattered);
  sums.square += squared(reflected + scattered - taken);
  sums.reflected_square += squared(reflected);
  sums.scattered_square += squared(scattered);
  add_sight(sums, sample);
}

void Film::add_sights(std::size_t pixel, const FeatureSums& feature_sums, std::uint32_t material) {
  const std::size_t held = pixel - first_pixel();
  pixels_[held].material = material;
  std::uint32_t& place = looked_[held];
  if (unused_.empty()) {
    place = static_cast<std::uint32_t>(looks_.size());
    looks_.push_back(feature_sums);
  } else {
    place = unused_.back();
    unused_.pop_back();
    looks_[place] = feature_sums;
  }
}

FeatureSums Film::feature_sums(std::size_t pixel) const {
  FeatureSums sum = at(pixel).feature_sums;
  const std::uint32_t looked = looked_[pixel - first_pixel()];
  if (looked == kNone) return sum;
  const FeatureSums& more = looks_[looked];
  sum.count += more.count;
  add_to(sum.emitted, to_vec(more.emitted));
  add_to(sum.background, to_vec(more.background));
  sum.alpha += more.alpha;
  add_to(sum.albedo, to_vec(more.albedo));
  add_to(sum.specular_albedo, to_vec(more.specular_albedo));
  add_to(sum.normal, to_vec(more.normal));
  sum.depth += more.depth;
  return sum;
}

Rgb Film::radiance(std::size_t pixel) const {
  const PixelSums& sums = at(pixel);
  if (sums.samples == 0) return {};
  const Rgb behind = to_vec(sums.feature_sums.background);
  const double seen = luminance(behind);
  const double lit = seen > 0 ? 1 - shadow(sums) / seen : 1;
  return (noisy(sums) + to_vec(sums.feature_sums.emitted) + behind * lit) /
         static_cast<double>(sums.samples);
}

double Film::error(std::size_t pixel) const {
  const PixelSums& sums = at(pixel);
  return standard_error(sums.samples, luminance(noisy(sums)) - shadow(sums), sums.square);
}

double Film::error(std::size_t pixel, LightPart part) const {
  const PixelSums& sums = at(pixel);
  const bool scattered = part == LightPart::scattered;
  const auto& halves = scattered ? sums.scattered : sums.reflected;
  return standard_error(sums.samples, luminance(to_vec(halves[0]) + to_vec(halves[1])),
                        scattered ? sums.scattered_square : sums.reflected_square);
}

}  // namespace gltfx::bake
