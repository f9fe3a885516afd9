// SPDX-License-Identifier: Apache-2.0
/// Properties of foreign images that OpenImageIO 2.4 does not report or gets wrong, from their
/// headers. Truncated bytes are no error here: the decoder finds it.
#pragma once

#include <cstddef>
#include <span>

namespace gltfx::codec {

/// Whether the fourth byte of each texel of a BMP is unused: 32 bits per texel without masks.
bool has_unused_byte(std::span<const std::byte> bmp);

/// Whether texels of the first frame of a GIF are transparent: those of one color, or those that
/// the frame does not cover.
bool is_transparent(std::span<const std::byte> gif);

/// Whether a TGA has alpha that OpenImageIO drops: in a palette, or as one bit of 16.
bool has_unread_alpha(std::span<const std::byte> tga);

/// Whether a TIFF has the default of one bit per sample, which OpenImageIO takes for eight.
bool has_default_bits(std::span<const std::byte> tiff);

}  // namespace gltfx::codec
