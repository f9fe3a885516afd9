// SPDX-License-Identifier: Apache-2.0
/// Samples of a pixel, or of adjacent pixels, whose rays are close together: tracing them together
/// takes a fraction of the time.
#pragma once

#include <algorithm>
#include <array>
#include <optional>
#include <span>

#include "render/bvh.hpp"
#include "render/view.hpp"

namespace gltfx::render {

/// Calls visit(sample, hit) for the samples [first, last), in their order. fill(i, samples) sets
/// those from number `i` on; `hit` is the first layer along the ray of a sample.
template <class Fill, class Visit>
void visit_camera_samples(const Bvh& bvh, std::uint32_t first, std::uint32_t last, const Fill& fill,
                          const Visit& visit) {
  std::array<CameraSample, Bvh::kCameraPacket> samples;
  std::array<Ray, Bvh::kCameraPacket> rays;
  std::array<std::optional<Hit>, Bvh::kCameraPacket> hits;
  while (first < last) {
    const std::uint32_t count = std::min(last - first, Bvh::kCameraPacket);
    fill(first, std::span(samples).first(count));
    for (std::uint32_t i = 0; i < count; ++i) rays[i] = samples[i].ray;
    bvh.first_layers(std::span(rays).first(count), hits);
    for (std::uint32_t i = 0; i < count; ++i) visit(samples[i], hits[i]);
    first += count;
  }
}

/// The same for the samples of one pixel.
template <class Visit>
void visit_camera_samples(const Bvh& bvh, std::uint32_t first, std::uint32_t last, const View& view,
                          const PixelSamples& pixel, const Visit& visit) {
  const auto fill = [&](std::uint32_t number, std::span<CameraSample> samples) {
    pixel.fill(view, number, samples);
  };
  visit_camera_samples(bvh, first, last, fill, visit);
}

}  // namespace gltfx::render
