// SPDX-License-Identifier: Apache-2.0
/// From radiance to pictures.
#pragma once

#include <cstdint>
#include <vector>

#include "bake/framebuffer.hpp"

namespace gltfx::bake {

/// Rows from the top, packed; alpha not multiplied in. Either bytes or floats are there.
struct Picture {
  std::uint32_t width = 0, height = 0;
  std::uint32_t channels = 3;       ///< 3 or 4
  std::vector<std::uint8_t> bytes;  ///< for a display: tone mapped, sRGB; alpha linear
  std::vector<float> floats;        ///< linear
};

/// What the pixels are to be used for.
enum class PixelType : std::uint8_t { bytes, floats };

/// The picture itself. With `alpha` there are four channels, and the buffer has to have it.
Picture tone_mapped_picture(const Framebuffer& buffer, bool alpha, PixelType type);

enum class Layer : std::uint8_t { albedo, normal, depth, material };

/// Of what was seen first. Precondition: the buffer has the layer, and alpha.
Picture layer_picture(const Framebuffer& buffer, Layer layer, PixelType type);

/// The mean square of the difference of bytes, over pixels in which either buffer shows something.
/// Precondition: pictures and canvases of one size and number of channels; the canvases have alpha.
double mean_square_difference(const Picture& a, const Picture& b, const Framebuffer& buffer_a,
                              const Framebuffer& buffer_b);

/// How much they differ, by pixel: grey where they are equal, and four times the difference around
/// it.
Picture difference(const Picture& a, const Picture& b);

}  // namespace gltfx::bake
