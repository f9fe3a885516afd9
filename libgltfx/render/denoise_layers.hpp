// SPDX-License-Identifier: Apache-2.0
/// The input of the denoiser: layers with noise, and features without.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "render/film.hpp"

namespace gltfx::render {

/// One value for each pixel, rows from the top.
using Plane = std::vector<float>;

/// Distances of the nearest and farthest surface that is seen.
struct DepthRange {
  float nearest = 0, farthest = 0;
};

/// Auxiliary features: normal (3), depth relative to its range (1), albedo (3).
constexpr std::size_t kFeatures = 7;
using FeaturePlanes = std::array<Plane, kFeatures>;

/// Values with noise.
struct DenoiseLayer {
  std::uint32_t width = 0, height = 0;
  std::vector<Plane> values;  ///< by channel
  Plane y;                    ///< luminance of the values
  Plane variance;             ///< of the luminance
  Plane weight;               ///< confidence in a pixel, from 0 to 1
};

/// Planes have the rows that the film holds.
FeaturePlanes features_of(const Film& film, const DepthRange& depths, unsigned jobs);

/// Scattered or reflected light, divided by the albedo or specular albedo (demodulated). The
/// confidence in a pixel is its alpha.
DenoiseLayer light_layer(const Film& film, LightPart part, unsigned jobs);
/// The albedo by which denoised light is multiplied again.
Rgb albedo_of(const FeatureSums& seen, LightPart part);

/// The part of the background that shadow takes away; one channel.
DenoiseLayer shadow_layer(const Film& film, unsigned jobs);

/// Rows above and below a pixel on which its variance depends.
constexpr int kVarianceReach = 7;

}  // namespace gltfx::render
