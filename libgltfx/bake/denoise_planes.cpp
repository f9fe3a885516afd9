// SPDX-License-Identifier: Apache-2.0
#include "bake/denoise_planes.hpp"

#include <algorithm>
#include <cmath>

#include "bake/storage.hpp"

namespace gltfx::bake {
namespace {

// Means over squares of 2 * radius + 1 pixels, cut off at the edges.
Plane blurred(const Plane& plane, std::uint32_t width, std::uint32_t height, int radius) {
  const auto across = [radius](const float* from, float* to, std::size_t count,
                               std::size_t stride) {
    const auto n = static_cast<std::ptrdiff_t>(count);
    const auto s = static_cast<std::ptrdiff_t>(stride);
    double sum = 0;
    std::ptrdiff_t first = 0;
    std::ptrdiff_t last = 0;  // of the window [first, last)
    for (std::ptrdiff_t i = 0; i < n; ++i) {
      for (; last < std::min(n, i + radius + 1); ++last) sum += static_cast<double>(from[last * s]);
      for (; first < i - radius; ++first) sum -= static_cast<double>(from[first * s]);
      to[i * s] = static_cast<float>(std::max(sum, 0.0) / static_cast<double>(last - first));
    }
  };
  Plane rows(plane.size());
  Plane result(plane.size());
  for (std::size_t y = 0; y < height; ++y) {
    across(plane.data() + y * width, rows.data() + y * width, width, 1);
  }
  for (std::size_t x = 0; x < width; ++x) across(rows.data() + x, result.data() + x, height, width);
  return result;
}

DenoiseLayer empty_layer(const Film& film, std::size_t channels) {
  DenoiseLayer layer;
  layer.width = film.width();
  layer.height = film.height();
  layer.values.assign(channels, Plane(film.size()));
  layer.y.resize(film.size());
  layer.weight.resize(film.size());
  for (Plane& plane : layer.features) plane.resize(film.size());
  return layer;
}

float count_of(const PixelSums& sums, std::size_t half) {
  const std::uint32_t count = (sums.samples + 1 - static_cast<std::uint32_t>(half)) / 2;
  return static_cast<float>(std::max(count, 1U));
}

// What samples say of their spread is too much, since they are spread evenly on purpose: it is
// scaled by how much the halves differ around.
void settle_variance(DenoiseLayer& layer, const Plane& claimed, const Plane& apart) {
  constexpr int kWide = 6;
  const Plane seen = blurred(apart, layer.width, layer.height, kWide);
  const Plane said = blurred(claimed, layer.width, layer.height, kWide);
  layer.variance.resize(claimed.size());
  for (std::size_t i = 0; i < claimed.size(); ++i) {
    const float scale = said[i] > 0 ? std::min(seen[i] / said[i], 2.0F) : 1.0F;
    layer.variance[i] = claimed[i] * scale;
  }
  layer.variance = blurred(layer.variance, layer.width, layer.height, 1);
}

void read_features(const Sights& seen, std::size_t i, DenoiseLayer& layer) {
  if (seen.alpha <= 0) return;
  for (std::size_t c = 0; c < 3; ++c) {
    layer.features[c][i] = seen.normal[c] / seen.alpha;
    layer.features[4 + c][i] = seen.albedo[c] / seen.alpha;
  }
  layer.features[3][i] = seen.depth / seen.alpha;
}

// Where a colour is next to black, what it would show is guessed by the others.
Rgb light_on(const Rgb& sent, const Rgb& color) {
  constexpr double kBlack = 0.002;
  const double mean = luminance(sent) / luminance(color);
  return (sent + Rgb(kBlack * mean)) / (color + Rgb(kBlack));
}

// Depths in parts of what lies between the nearest and the farthest.
void scale_depth(Plane& depth) {
  float nearest = 0;
  float farthest = 0;
  for (const float z : depth) {
    if (z <= 0) continue;
    nearest = nearest == 0 ? z : std::min(nearest, z);
    farthest = std::max(farthest, z);
  }
  const float scale = farthest > nearest ? 1 / (farthest - nearest) : 0;
  for (float& z : depth) z = z > 0 ? std::min((z - nearest) * scale, 1.0F) : 0.0F;
}

}  // namespace

Rgb surface_color(const Sights& seen, LightPart part) {
  const double count = std::max(seen.count, 1U);
  return to_vec(part == LightPart::scattered ? seen.albedo : seen.mirror) / Rgb(count);
}

DenoiseLayer light_layer(const Film& film, LightPart part) {
  DenoiseLayer layer = empty_layer(film, 3);
  Plane claimed(film.size());
  Plane apart(film.size());
  for (std::size_t i = 0; i < film.size(); ++i) {
    const PixelSums& sums = film.at(i);
    const Rgb color = surface_color(sums.sights, part);
    layer.weight[i] = sums.sights.alpha / static_cast<float>(std::max(sums.samples, 1U));
    if (!(max_value(color) > 0)) continue;
    const auto& halves = part == LightPart::scattered ? sums.scattered : sums.reflected;
    std::array<Rgb, 2> light;
    for (std::size_t half = 0; half < 2; ++half) {
      light[half] = light_on(to_vec(halves[half]) / Rgb(count_of(sums, half)), color);
    }
    const Rgb mean = (light[0] + light[1]) / 2;
    const Float3 parts = to_float3(mean);
    for (std::size_t c = 0; c < 3; ++c) layer.values[c][i] = parts[c];
    layer.y[i] = static_cast<float>(luminance(mean));
    const double difference = luminance(light[0]) - luminance(light[1]);
    apart[i] = static_cast<float>(difference * difference / 4) * layer.weight[i];
    const double error = film.error(i, part) / luminance(color);
    claimed[i] = static_cast<float>(error * error * static_cast<double>(layer.weight[i]));
    read_features(film.sights(i), i, layer);
  }
  scale_depth(layer.features[3]);
  settle_variance(layer, claimed, apart);
  return layer;
}

DenoiseLayer shadow_layer(const Film& film) {
  DenoiseLayer layer = empty_layer(film, 1);
  Plane claimed(film.size());
  Plane apart(film.size());
  for (std::size_t i = 0; i < film.size(); ++i) {
    const PixelSums& sums = film.at(i);
    const auto seen = static_cast<float>(luminance(to_vec(sums.sights.behind)));
    const float alpha = sums.sights.alpha / static_cast<float>(std::max(sums.samples, 1U));
    layer.weight[i] = std::max(1 - alpha, 0.0F);
    if (!(seen > 0)) continue;
    std::array<float, 2> part{};
    for (std::size_t half = 0; half < 2; ++half) {
      part[half] =
          sums.shadow[half] * static_cast<float>(sums.samples) / (seen * count_of(sums, half));
    }
    const float mean = (part[0] + part[1]) / 2;
    layer.values[0][i] = layer.y[i] = mean;
    apart[i] = (part[0] - part[1]) * (part[0] - part[1]) / 4 * layer.weight[i];
    // As if each sample said yes or no.
    claimed[i] = mean / static_cast<float>(sums.samples) * layer.weight[i];
  }
  settle_variance(layer, claimed, apart);
  return layer;
}

}  // namespace gltfx::bake
