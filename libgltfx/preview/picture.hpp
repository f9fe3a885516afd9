// SPDX-License-Identifier: Apache-2.0
/// Pictures in the pixel format of a file.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "render/framebuffer.hpp"
#include "render/tone_curve.hpp"

namespace gltfx::preview {

/// Rows from the top, packed; alpha not premultiplied. Either bytes or floats are set.
struct Picture {
  std::uint32_t width = 0, height = 0;
  std::uint32_t channels = 3;       ///< 3 or 4
  std::vector<std::uint8_t> bytes;  ///< for a display: tone mapped, sRGB; alpha linear
  std::vector<float> floats;        ///< linear
};

enum class PixelType : std::uint8_t { bytes, floats };

struct Finish {
  render::ToneCurve curve = render::ToneCurve::neutral;  ///< of bytes
  /// Linear, put behind the scene as it is. Needs a buffer with alpha and without background.
  std::optional<Float3> color;
};

/// The radiance, tone mapped if the pixels are bytes. With `alpha` there are four channels.
/// Precondition: the buffer has alpha then.
Picture tone_mapped_picture(const render::Framebuffer& buffer, bool alpha, PixelType type,
                            const Finish& finish = {});

enum class Layer : std::uint8_t { albedo, normal, depth, material };

/// A feature layer. Precondition: the buffer has the layer, and alpha.
Picture layer_picture(const render::Framebuffer& buffer, Layer layer, PixelType type);

/// Contrast of the edges of the drawn objects: the mean difference of lightness (CIE L*, 0 to 100)
/// between pixels inside and outside. 100 if there is no edge. Precondition: the buffer has alpha.
double edge_contrast(const render::Framebuffer& buffer, render::ToneCurve curve);

}  // namespace gltfx::preview
