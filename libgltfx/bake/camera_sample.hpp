// SPDX-License-Identifier: Apache-2.0
/// Camera rays.
#pragma once

#include <cmath>
#include <cstdint>

#include "bake/ray.hpp"
#include "bake/sampler.hpp"
#include "bake/view.hpp"

namespace gltfx::bake {

struct CameraSample {
  Ray ray;
  Float2 point;  ///< of the picture, x and y from 0 to 1
  SampleStream random;
};

/// A sample in a picture of width x height pixels. Positions are distributed by a tent filter two
/// pixels wide: edges are smooth, and samples of different pixels stay independent.
inline CameraSample camera_sample(const View& view, std::uint32_t width, std::uint32_t height,
                                  std::uint32_t seed, std::uint32_t x, std::uint32_t y,
                                  std::uint32_t sample) {
  const auto tent = [](float random) {
    const double r = static_cast<double>(random) * 2;
    return r < 1 ? std::sqrt(r) - 1 : 1 - std::sqrt(2 - r);
  };
  const SampleStream random(seed, y * width + x, sample);
  const Float2 jitter = random.pair(0);
  const double px = (x + 0.5 + tent(jitter[0])) / width;
  const double py = (y + 0.5 + tent(jitter[1])) / height;
  return {view.ray(px, py), {static_cast<float>(px), static_cast<float>(py)}, random};
}

}  // namespace gltfx::bake
