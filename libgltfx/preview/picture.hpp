// SPDX-License-Identifier: Apache-2.0
/// Pictures in the pixel format of a file.
#pragma once

#include <cstdint>
#include <vector>

#include "render/framebuffer.hpp"

namespace gltfx::preview {

/// Rows from the top, packed; alpha not premultiplied. Either bytes or floats are set.
struct Picture {
  std::uint32_t width = 0, height = 0;
  std::uint32_t channels = 3;       ///< 3 or 4
  std::vector<std::uint8_t> bytes;  ///< for a display: tone mapped, sRGB; alpha linear
  std::vector<float> floats;        ///< linear
};

enum class PixelType : std::uint8_t { bytes, floats };

/// The radiance, tone mapped if the pixels are bytes. With `alpha` there are four channels.
/// Precondition: the buffer has alpha then.
Picture tone_mapped_picture(const render::Framebuffer& buffer, bool alpha, PixelType type);

enum class Layer : std::uint8_t { albedo, normal, depth, material };

/// A feature layer. Precondition: the buffer has the layer, and alpha.
Picture layer_picture(const render::Framebuffer& buffer, Layer layer, PixelType type);

/// Contrast of the edges of the drawn objects: the mean difference of lightness (CIE L*, 0 to 100)
/// between pixels inside and outside. 100 if there is no edge. Precondition: the buffer has alpha.
double edge_contrast(const render::Framebuffer& buffer);

/// The mean square of the difference of bytes, over pixels in which either buffer shows something.
/// Precondition: pictures and buffers of one size and number of channels; the buffers have alpha.
double mean_square_difference(const Picture& a, const Picture& b,
                              const render::Framebuffer& buffer_a,
                              const render::Framebuffer& buffer_b);

/// The mean structural similarity of the same pixels, at most 1 (for equal pictures): of luma, in
/// Gaussian windows of 11 by 11 pixels that end with the picture (Z. Wang, A. Bovik, H. Sheikh and
/// E. Simoncelli, Image Quality Assessment: From Error Visibility to Structural Similarity, IEEE
/// Transactions on Image Processing 13, 2004). 1 if neither shows anything. Precondition: as above.
double structural_similarity(const Picture& a, const Picture& b,
                             const render::Framebuffer& buffer_a,
                             const render::Framebuffer& buffer_b);

/// The difference by pixel: grey, plus four times the difference.
Picture difference(const Picture& a, const Picture& b);

}  // namespace gltfx::preview
