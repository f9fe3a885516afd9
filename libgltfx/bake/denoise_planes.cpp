// SPDX-License-Identifier: Apache-2.0
#include "bake/denoise_planes.hpp"

#include <algorithm>
#include <cmath>

#include "bake/storage.hpp"

namespace gltfx::bake {
namespace {

constexpr float kDarkest = 0.03F;  // albedo; below, noise would be divided by next to nothing

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

// What samples say of their spread is too much, since they are spread evenly on purpose: it is
// scaled by how much the halves differ around.
void estimate_variance(const Film& film, DenoisePlanes& planes) {
  Plane apart(film.size());
  Plane claimed(film.size());
  for (std::size_t i = 0; i < film.size(); ++i) {
    const float difference = planes.y[0][i] - planes.y[1][i];
    apart[i] = difference * difference / 2;
    const double y = std::max(luminance({static_cast<double>(planes.albedo[0][i]),
                                         static_cast<double>(planes.albedo[1][i]),
                                         static_cast<double>(planes.albedo[2][i])}),
                              1e-3);
    const double error = film.error(i) / y;
    claimed[i] = static_cast<float>(2 * error * error);  // of a half
  }
  constexpr int kWide = 6;
  const Plane seen = blurred(apart, planes.width, planes.height, kWide);
  const Plane said = blurred(claimed, planes.width, planes.height, kWide);
  Plane variance(film.size());
  for (std::size_t i = 0; i < film.size(); ++i) {
    const float scale = said[i] > 0 ? std::min(seen[i] / said[i], 2.0F) : 1.0F;
    variance[i] = claimed[i] * scale;
  }
  planes.variance[0] = planes.variance[1] = blurred(variance, planes.width, planes.height, 1);
}

void read_pixel(const Film& film, std::size_t i, DenoisePlanes& planes) {
  const PixelSums& sums = film.at(i);
  const auto count = static_cast<float>(std::max(sums.samples, 1U));
  std::array<Float3, 2> light{};
  for (std::size_t c = 0; c < 3; ++c) {
    planes.albedo[c][i] = std::max(sums.albedo[c] / count, kDarkest);
    for (std::size_t half = 0; half < 2; ++half) {
      const std::uint32_t own = (sums.samples + 1 - static_cast<std::uint32_t>(half)) / 2;
      light[half][c] =
          sums.scattered[half][c] / (static_cast<float>(std::max(own, 1U)) * planes.albedo[c][i]);
      planes.light[half][c][i] = light[half][c];
    }
    planes.features[c][i] = sums.normal[c] / count;
  }
  planes.features[3][i] = sums.depth / count;
  planes.features[4][i] = sums.alpha / count;
  for (std::size_t half = 0; half < 2; ++half) {
    planes.y[half][i] = static_cast<float>(luminance(to_vec(light[half])));
  }
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

DenoisePlanes denoise_planes(const Film& film) {
  DenoisePlanes planes;
  planes.width = film.width();
  planes.height = film.height();
  for (auto& half : planes.light) {
    for (Plane& plane : half) plane.resize(film.size());
  }
  for (Plane& plane : planes.y) plane.resize(film.size());
  for (Plane& plane : planes.features) plane.resize(film.size());
  for (Plane& plane : planes.albedo) plane.resize(film.size());
  for (std::size_t i = 0; i < film.size(); ++i) read_pixel(film, i, planes);
  scale_depth(planes.features[3]);
  estimate_variance(film, planes);
  return planes;
}

}  // namespace gltfx::bake
