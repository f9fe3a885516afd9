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

/// Something that is to be smooth, known from two halves of the samples.
struct DenoiseLayer {
  std::uint32_t width = 0, height = 0;
  std::array<std::vector<Plane>, 2> values;  ///< by half and channel
  std::array<Plane, 2> y;                    ///< their luminance
  Plane variance;                            ///< of that, of one half
  Plane weight;                              ///< how much a pixel says, from 0 (nothing) to 1
  static constexpr std::size_t kFeatures = 7;
  std::array<Plane, kFeatures> features;  ///< normal, depth from 0 to 1, colour of the surface
};

/// Light on the surfaces, divided by their colour. What the surfaces cover is what a pixel says.
DenoiseLayer surface_layer(const Film& film);
/// By which that light is multiplied again.
Rgb surface_color(const PixelSums& sums);

/// The part of the background that shadow takes away; one channel.
DenoiseLayer shadow_layer(const Film& film);

}  // namespace gltfx::bake
