// SPDX-License-Identifier: Apache-2.0
/// A film as the denoiser looks at it.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "bake/film.hpp"

namespace gltfx::bake {

/// A number by pixel, rows from the top.
using Plane = std::vector<float>;

struct DenoisePlanes {
  std::uint32_t width = 0, height = 0;
  /// Of each half of the samples: what is scattered, divided by the colour of the surface.
  std::array<std::array<Plane, 3>, 2> light;
  std::array<Plane, 2> y;         ///< its luminance
  std::array<Plane, 2> variance;  ///< of that
  static constexpr std::size_t kFeatures = 5;
  std::array<Plane, kFeatures> features;  ///< normal, depth in parts of the scene, alpha
  std::array<Plane, 3> albedo;            ///< by which the light is to be multiplied again
};

/// A film of at least one sample a pixel.
DenoisePlanes denoise_planes(const Film& film);

}  // namespace gltfx::bake
