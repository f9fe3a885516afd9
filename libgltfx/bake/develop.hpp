// SPDX-License-Identifier: Apache-2.0
/// From radiance to pictures.
#pragma once

#include <cstdint>
#include <vector>

#include "bake/canvas.hpp"

namespace gltfx::bake {

/// Rows from the top, packed; alpha not multiplied in. Either bytes or floats are there.
struct Picture {
  std::uint32_t width = 0, height = 0;
  std::uint32_t channels = 3;       ///< 3 or 4
  std::vector<std::uint8_t> bytes;  ///< for a display: tone mapped, sRGB; alpha linear
  std::vector<float> floats;        ///< linear
};

/// What the pixels are to be used for.
enum class Numbers : std::uint8_t { bytes, floats };

/// The picture itself. With `alpha` there are four channels, and the canvas has to have it.
Picture develop(const Canvas& canvas, bool alpha, Numbers numbers);

enum class Layer : std::uint8_t { albedo, normal, depth, material };

/// Of what was seen first. Precondition: the canvas has the layer, and alpha.
Picture develop_layer(const Canvas& canvas, Layer layer, Numbers numbers);

/// The mean square of the difference of bytes, over pixels in which either canvas shows something.
/// Precondition: pictures and canvases of one size and number of channels; the canvases have alpha.
double mean_square_difference(const Picture& a, const Picture& b, const Canvas& canvas_a,
                              const Canvas& canvas_b);

/// How much they differ, by pixel: grey where they are equal, and four times the difference around
/// it.
Picture difference(const Picture& a, const Picture& b);

}  // namespace gltfx::bake
