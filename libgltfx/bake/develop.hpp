// SPDX-License-Identifier: Apache-2.0
/// From radiance to pictures.
#pragma once

#include <cstdint>
#include <vector>

#include "bake/film.hpp"

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

/// The picture itself. `radiance`: by pixel, as Film::radiance() or denoise() give it. With `alpha`
/// there are four channels.
Picture develop(const Film& film, const std::vector<Rgb>& radiance, bool alpha, Numbers numbers);

enum class Layer : std::uint8_t { albedo, normal, depth, material };

/// Of what was seen first, averaged over the samples.
Picture develop_layer(const Film& film, Layer layer, Numbers numbers);

/// The mean square of the difference of bytes, over pixels in which either film shows something.
/// Precondition: pictures and films of one size and number of channels.
double mean_square_difference(const Picture& a, const Picture& b, const Film& film_a,
                              const Film& film_b);

/// How much they differ, by pixel: grey where they are equal, and four times the difference around
/// it.
Picture difference(const Picture& a, const Picture& b);

}  // namespace gltfx::bake
