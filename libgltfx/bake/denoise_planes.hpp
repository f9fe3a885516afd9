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

/// Something that is to be smooth, with noise.
struct DenoiseLayer {
  std::uint32_t width = 0, height = 0;
  std::vector<Plane> values;  ///< by channel
  Plane y;                    ///< their luminance
  Plane variance;             ///< of that
  Plane weight;               ///< how much a pixel says, from 0 (nothing) to 1
  static constexpr std::size_t kFeatures = 7;
  std::array<Plane, kFeatures> features;  ///< normal, depth from 0 to 1, colour of the surface
};

/// Light that surfaces scatter, divided by their colour, or that the ones seen first reflect,
/// divided by what tints it. What the surfaces cover is what a pixel says.
DenoiseLayer light_layer(const Film& film, LightPart part);
/// By which that light is multiplied again.
Rgb surface_color(const Sights& seen, LightPart part);

/// The part of the background that shadow takes away; one channel.
DenoiseLayer shadow_layer(const Film& film);

}  // namespace gltfx::bake
