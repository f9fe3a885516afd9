// SPDX-License-Identifier: Apache-2.0
/// Handling of alpha when an image is made smaller.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "codec/image_options.hpp"

namespace gltfx::codec {

/// Floats of an image, `channels` per texel; the last one is alpha from 0 to 1.
struct AlphaTexels {
  std::span<float> values;
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  unsigned channels = 4;

  std::size_t count() const { return std::size_t{width} * height; }
  float& alpha(std::size_t texel) const { return values[texel * channels + channels - 1]; }
};

/// The alphas on both sides of a cutoff, in an image whose alphas are multiples of a step.
struct Cutoff {
  float value = 0;  ///< cutoff of the material
  float fails = 0;  ///< the greatest alpha below it
  float shows = 0;  ///< the least alpha at or above it
};

/// Scales alphas so that the share `share` (0 to 1) of the texels is visible. If many alphas are
/// equal, some of these texels are visible, evenly spread.
void keep_coverage(const AlphaTexels& texels, double share, const Cutoff& cutoff);

/// Fills the colours of texels in `unknown` from their neighbours, the nearest first. If no texel
/// is known, nothing changes.
void fill_colors(const AlphaTexels& texels, std::vector<bool> unknown, const Resize& how);

}  // namespace gltfx::codec
