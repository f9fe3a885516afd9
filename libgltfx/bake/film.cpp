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

bool is_finite(const Rgb& c) { return std::isfinite(c.x + c.y + c.z); }

}  // namespace

void Film::add(std::size_t pixel, const PathSample& sample) {
  PixelSums& sums = pixels_[pixel];
  const std::size_t half = sums.samples & 1U;
  if (is_finite(sample.radiance())) {
    add_to(sums.scattered[half], sample.scattered);
    add_to(sums.direct, sample.direct);
    add_to(sums.behind, sample.behind);
    sums.shadow[half] += static_cast<float>(luminance(sample.behind) * sample.shadow);
    const double y = luminance(sample.scattered);
    sums.square += static_cast<float>(y * y);
  }
  ++sums.samples;
  sums.rays += sample.rays;
  sums.alpha += static_cast<float>(sample.alpha);
  add_to(sums.albedo, sample.albedo);
  add_to(sums.normal, sample.normal);
  sums.depth += static_cast<float>(sample.depth);
  sums.albedo_square += static_cast<float>(dot(sample.albedo, sample.albedo));
  sums.normal_square += static_cast<float>(dot(sample.normal, sample.normal));
  sums.depth_square += static_cast<float>(sample.depth * sample.depth);
  if (sums.material == kNone) sums.material = sample.material;
}

Rgb Film::radiance(std::size_t pixel) const {
  const PixelSums& sums = pixels_[pixel];
  if (sums.samples == 0) return {};
  const Rgb behind = to_vec(sums.behind);
  const double seen = luminance(behind);
  const double shadow = static_cast<double>(sums.shadow[0]) + static_cast<double>(sums.shadow[1]);
  return (to_vec(sums.scattered[0]) + to_vec(sums.scattered[1]) + to_vec(sums.direct) +
          behind * (seen > 0 ? 1 - shadow / seen : 1)) /
         static_cast<double>(sums.samples);
}

double Film::alpha(std::size_t pixel) const {
  const PixelSums& sums = pixels_[pixel];
  if (sums.samples == 0) return 0;
  return static_cast<double>(sums.alpha) / sums.samples;
}

double Film::error(std::size_t pixel) const {
  const PixelSums& sums = pixels_[pixel];
  if (sums.samples < 2) return 0;
  const double count = sums.samples;
  const double mean = luminance(to_vec(sums.scattered[0]) + to_vec(sums.scattered[1])) / count;
  const double variance = static_cast<double>(sums.square) / count - mean * mean;
  return std::sqrt(std::max(variance, 0.0) / (count - 1));
}

}  // namespace gltfx::bake
