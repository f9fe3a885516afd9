// SPDX-License-Identifier: Apache-2.0
#include "render/denoise_layers.hpp"

#include <algorithm>
#include <cmath>

#include "base/packed.hpp"
#include "base/parallel.hpp"

namespace gltfx::render {
namespace {

constexpr int kWide = 6;  // radius in which the halves are compared
constexpr int kNear = 1;  // radius in which variances are averaged
static_assert(kWide + kNear == kVarianceReach);

// visit(index in the planes, index in the picture) for each pixel that is held.
template <class Visit>
void for_pixels(const Film& film, unsigned jobs, const Visit& visit) {
  const std::uint32_t rows = film.held().last - film.held().first;
  const auto work = [&](std::size_t row) {
    for (std::size_t i = row * film.width(); i < (row + 1) * film.width(); ++i) {
      visit(i, film.first_pixel() + i);
    }
  };
  parallel_ordered(rows, jobs, work, [](std::size_t) {});
}

void blur_row(const float* from, float* to, std::size_t count, int radius) {
  const auto n = static_cast<std::ptrdiff_t>(count);
  double sum = 0;
  std::ptrdiff_t first = 0;
  std::ptrdiff_t last = 0;  // of the window [first, last)
  for (std::ptrdiff_t i = 0; i < n; ++i) {
    for (; last < std::min(n, i + radius + 1); ++last) sum += static_cast<double>(from[last]);
    for (; first < i - radius; ++first) sum -= static_cast<double>(from[first]);
    to[i] = static_cast<float>(std::max(sum, 0.0) / static_cast<double>(last - first));
  }
}

// Means over squares of 2 * radius + 1 pixels, cut off at the edges. Columns are summed again for
// each row, so that the result does not depend on the start of the plane.
void blur(Plane& plane, std::size_t width, std::size_t height, int radius) {
  Plane rows(plane.size());
  for (std::size_t y = 0; y < height; ++y) {
    blur_row(plane.data() + y * width, rows.data() + y * width, width, radius);
  }
  const auto reach = static_cast<std::size_t>(radius);
  for (std::size_t y = 0; y < height; ++y) {
    const std::size_t first = y - std::min(y, reach);
    const std::size_t last = std::min(y + reach + 1, height);
    const float share = 1 / static_cast<float>(last - first);
    float* to = plane.data() + y * width;
    std::fill_n(to, width, 0.0F);
    for (std::size_t row = first; row < last; ++row) {
      const float* from = rows.data() + row * width;
      for (std::size_t x = 0; x < width; ++x) to[x] += from[x] * share;
    }
  }
}

DenoiseLayer empty_layer(const Film& film, std::size_t channels) {
  DenoiseLayer layer;
  layer.width = film.width();
  layer.height = film.held().last - film.held().first;
  layer.values.assign(channels, Plane(film.size()));
  layer.y.resize(film.size());
  layer.weight.resize(film.size());
  return layer;
}

float count_of(const PixelSums& sums, std::size_t half) {
  const std::uint32_t count = (sums.samples + 1 - static_cast<std::uint32_t>(half)) / 2;
  return static_cast<float>(std::max(count, 1U));
}

// The variance of the samples is too large, because they are stratified: it is scaled to the
// variance between the two halves around a pixel.
void calibrate_variance(DenoiseLayer& layer, Plane sample_variance, Plane half_variance) {
  layer.variance = sample_variance;
  blur(half_variance, layer.width, layer.height, kWide);
  blur(sample_variance, layer.width, layer.height, kWide);
  for (std::size_t i = 0; i < sample_variance.size(); ++i) {
    layer.variance[i] *=
        sample_variance[i] > 0 ? std::min(half_variance[i] / sample_variance[i], 2.0F) : 1.0F;
  }
  blur(layer.variance, layer.width, layer.height, kNear);
}

// Where one channel of the albedo is almost black, its light is guessed from the other channels.
Rgb demodulated(const Rgb& light, const Rgb& albedo) {
  constexpr double kBlack = 0.002;
  const double mean = luminance(light) / luminance(albedo);
  return (light + Rgb(kBlack * mean)) / (albedo + Rgb(kBlack));
}

// 0 at the nearest surface, 1 at the farthest; behind glass it may be more.
float scaled_depth(float z, const DepthRange& depths) {
  constexpr float kBeyond = 2;
  const float span = depths.farthest - depths.nearest;
  if (!(span > 0 && z > 0)) return 0;
  return std::clamp((z - depths.nearest) / span, 0.0F, kBeyond);
}

}  // namespace

FeaturePlanes features_of(const Film& film, const DepthRange& depths, unsigned jobs) {
  FeaturePlanes features;
  for (Plane& plane : features) plane.resize(film.size());
  for_pixels(film, jobs, [&](std::size_t i, std::size_t pixel) {
    const FeatureSums& seen = film.features(pixel);
    if (seen.alpha <= 0) return;
    for (std::size_t c = 0; c < 3; ++c) {
      features[c][i] = seen.normal[c] / seen.alpha;
      features[4 + c][i] = seen.albedo[c] / seen.alpha;
    }
    features[3][i] = scaled_depth(seen.depth / seen.alpha, depths);
  });
  return features;
}

Rgb albedo_of(const FeatureSums& seen, LightPart part) {
  const double count = std::max(seen.count, 1U);
  return to_vec(part == LightPart::scattered ? seen.albedo : seen.specular_albedo) / Rgb(count);
}

DenoiseLayer light_layer(const Film& film, LightPart part, unsigned jobs) {
  DenoiseLayer layer = empty_layer(film, 3);
  Plane sample_variance(film.size());
  Plane half_variance(film.size());
  for_pixels(film, jobs, [&](std::size_t i, std::size_t pixel) {
    const PixelSums& sums = film.at(pixel);
    const Rgb albedo = albedo_of(sums.features, part);
    layer.weight[i] = sums.features.alpha / static_cast<float>(std::max(sums.samples, 1U));
    if (!(max_value(albedo) > 0)) return;
    const auto& halves = part == LightPart::scattered ? sums.light.scattered : sums.light.reflected;
    std::array<Rgb, 2> light;
    for (std::size_t half = 0; half < 2; ++half) {
      light[half] = demodulated(to_vec(halves[half]) / Rgb(count_of(sums, half)), albedo);
    }
    const Rgb mean = (light[0] + light[1]) / 2;
    const Float3 parts = to_float3(mean);
    for (std::size_t c = 0; c < 3; ++c) layer.values[c][i] = parts[c];
    layer.y[i] = static_cast<float>(luminance(mean));
    const double difference = luminance(light[0]) - luminance(light[1]);
    half_variance[i] = static_cast<float>(difference * difference / 4) * layer.weight[i];
    const double error = film.error(pixel, part) / luminance(albedo);
    sample_variance[i] = static_cast<float>(error * error * static_cast<double>(layer.weight[i]));
  });
  calibrate_variance(layer, std::move(sample_variance), std::move(half_variance));
  return layer;
}

DenoiseLayer shadow_layer(const Film& film, unsigned jobs) {
  DenoiseLayer layer = empty_layer(film, 1);
  Plane sample_variance(film.size());
  Plane half_variance(film.size());
  for_pixels(film, jobs, [&](std::size_t i, std::size_t pixel) {
    const PixelSums& sums = film.at(pixel);
    const auto seen = static_cast<float>(luminance(to_vec(sums.features.background)));
    const float alpha = sums.features.alpha / static_cast<float>(std::max(sums.samples, 1U));
    layer.weight[i] = std::max(1 - alpha, 0.0F);
    if (!(seen > 0)) return;
    std::array<float, 2> part{};
    for (std::size_t half = 0; half < 2; ++half) {
      part[half] = sums.light.shadow[half] * static_cast<float>(sums.samples) /
                   (seen * count_of(sums, half));
    }
    const float mean = (part[0] + part[1]) / 2;
    layer.values[0][i] = layer.y[i] = mean;
    half_variance[i] = (part[0] - part[1]) * (part[0] - part[1]) / 4 * layer.weight[i];
    // As for a binary outcome of each sample.
    sample_variance[i] = mean / static_cast<float>(sums.samples) * layer.weight[i];
  });
  calibrate_variance(layer, std::move(sample_variance), std::move(half_variance));
  return layer;
}

}  // namespace gltfx::render
