// SPDX-License-Identifier: Apache-2.0
/// Options for resizing and encoding images.
#pragma once

#include <cstdint>

namespace gltfx::codec {

/// The meaning of texels, which selects how they are averaged.
enum class TexelKind : std::uint8_t {
  color,   ///< sRGB: averaged as linear light. Floats are linear already
  normal,  ///< RGB are the vector 2c - 1: averaged, then normalized
  data,    ///< numbers; each channel is averaged separately
};

/// Texels outside of the image, as in a sampler.
enum class Wrap : std::uint8_t { repeat, clamp, mirror };

/// Makes an image smaller, never larger; the aspect ratio stays. Values are clamped to the range of
/// the input around them, which prevents ringing.
struct Resize {
  std::uint32_t max_side = 0;  ///< texels; 0: unchanged
  TexelKind kind = TexelKind::data;
  /// Colours are weighted by alpha, and texels that become transparent get the colours of their
  /// neighbours.
  bool weigh_alpha = false;
  /// Above 0: the share of texels with at least this alpha (0 to 1) stays the same.
  float alpha_cutoff = 0;
  Wrap wrap_u = Wrap::repeat;  ///< horizontal
  Wrap wrap_v = Wrap::repeat;  ///< vertical

  bool needed(std::uint32_t width, std::uint32_t height) const {
    return max_side != 0 && (width > max_side || height > max_side);
  }
  bool operator==(const Resize&) const = default;
};

/// KTX2: UASTC with Zstandard and all mipmap levels, in sRGB if the texels are colours.
enum class EncodedFormat : std::uint8_t { png, jpeg, webp, exr, ktx2, avif };

struct EncodeOptions {
  /// Lossless WebP: 100 keeps all bits; lower numbers allow small changes of values for better
  /// compression: by at most 2 of 255 with 60.
  std::uint32_t near_lossless = 100;
  /// JPEG: colour at half the resolution (4:2:0). Not suitable for data other than colours.
  bool subsampled = true;
  /// PNG: the greatest effort, with several filters. JPEG: optimized tables.
  bool smallest = false;
  /// WebP: the raster is that many frames of an animation without end, one below the other, each
  /// shown for so many microseconds.
  std::uint32_t frames = 1;
  std::uint32_t frame_microseconds = 0;
  bool operator==(const EncodeOptions&) const = default;
};

}  // namespace gltfx::codec
