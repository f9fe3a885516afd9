// SPDX-License-Identifier: Apache-2.0
/// What becomes of alpha when an image is made smaller.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "codec/image_options.hpp"

namespace gltfx::codec {

/// Floats of an image, `channels` a texel, the last of them alpha of 0 to 1.
struct AlphaTexels {
  std::span<float> values;
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  unsigned channels = 4;

  std::size_t count() const { return std::size_t{width} * height; }
  float& alpha(std::size_t texel) const { return values[texel * channels + channels - 1]; }
};

/// The alphas between which a cutoff divides, in an image whose alphas are multiples of a step.
struct Cutoff {
  float value = 0;  ///< that of the material
  float fails = 0;  ///< the greatest alpha below it
  float shows = 0;  ///< the least alpha that is not
};

/// Scales alphas so that `share` of the texels, of 0 to 1, show. Of equal alphas some show and some
/// do not, spread evenly.
void keep_coverage(const AlphaTexels& texels, double share, const Cutoff& cutoff);

/// Gives colours to the texels in `unknown` from their neighbours, the nearest first. Without any
/// texel that is known nothing changes.
void fill_colors(const AlphaTexels& texels, std::vector<bool> unknown, const Resize& how);

}  // namespace gltfx::codec
