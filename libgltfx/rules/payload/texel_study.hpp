// SPDX-License-Identifier: Apache-2.0
/// What rules learn from the texels of a decoded image, so that the pixels need not be kept.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "codec/client.hpp"

namespace gltfx::validate {

/// An image read as a normal map: whether its vectors are the slopes of a surface. A surface has
/// one slope for each direction, and the change of the slope in x along y is that of the slope in y
/// along x. Squares of 8 by 8 texels are compared, a sample of them in large images.
struct SlopeStudy {
  std::uint64_t up = 0;           ///< squares where that is so if green points up the image
  std::uint64_t down = 0;         ///< squares where it is so if green points down
  std::uint64_t rough = 0;        ///< squares where neither is so
  std::uint64_t seen = 0;         ///< texels of all squares, flat ones included
  std::uint64_t unit = 0;         ///< of these, vectors of about unit length that point outwards
  double mean_x = 0, mean_y = 0;  ///< of the vectors
};
/// Precondition: the image has pixels of 8 or 16 bits and at least three channels.
SlopeStudy study_slopes(const codec::Image& image);

/// Texels by their alpha, one bit each in the order of the rows.
struct AlphaStudy {
  std::vector<std::uint64_t> not_opaque;  ///< alpha is less than 250 of 255
  std::vector<std::uint64_t> between;     ///< alpha is from 16 to 239 of 255

  static bool has(const std::vector<std::uint64_t>& bits, std::uint64_t texel) {
    return (bits[static_cast<std::size_t>(texel / 64)] >> texel % 64 & 1U) != 0;
  }
};
/// Precondition: the image has pixels of 8 or 16 bits and alpha.
AlphaStudy study_alpha(const codec::Image& image);

}  // namespace gltfx::validate
