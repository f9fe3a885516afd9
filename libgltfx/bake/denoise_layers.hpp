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

/// Distances between which lies what is seen.
struct DepthRange {
  float nearest = 0, farthest = 0;
};

/// What is known of surfaces without noise: normal, depth by its range, colour.
constexpr std::size_t kFeatures = 7;
using FeaturePlanes = std::array<Plane, kFeatures>;

/// Something that is to be smooth, with noise.
struct DenoiseLayer {
  std::uint32_t width = 0, height = 0;
  std::vector<Plane> values;  ///< by channel
  Plane y;                    ///< their luminance
  Plane variance;             ///< of that
  Plane weight;               ///< how much a pixel says, from 0 (nothing) to 1
};

/// All of them have the rows that the film holds.
FeaturePlanes features_of(const Film& film, const DepthRange& depths, unsigned jobs);

/// Light that surfaces scatter, divided by their colour, or that the ones seen first reflect,
/// divided by what tints it. What the surfaces cover is what a pixel says.
DenoiseLayer light_layer(const Film& film, LightPart part, unsigned jobs);
/// By which that light is multiplied again.
Rgb surface_color(const FeatureSums& seen, LightPart part);

/// The part of the background that shadow takes away; one channel.
DenoiseLayer shadow_layer(const Film& film, unsigned jobs);

/// Rows beyond a pixel's own on which its variance depends.
constexpr int kVarianceReach = 7;

}  // namespace gltfx::bake
