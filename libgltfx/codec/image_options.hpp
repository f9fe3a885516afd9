// SPDX-License-Identifier: Apache-2.0
/// How images are resized and encoded.
#pragma once

#include <cstdint>

namespace gltfx::codec {

/// What the texels of an image are, which decides how they are averaged.
enum class TexelKind : std::uint8_t {
  color,   ///< sRGB: averaged as linear light. Floats are linear already
  normal,  ///< RGB hold the vector 2c - 1: averaged, then made a unit vector again
  data,    ///< numbers, each channel by itself
};

/// What lies beyond a border, as a sampler has it.
enum class Wrap : std::uint8_t { repeat, clamp, mirror };

/// Makes an image smaller, never larger; the aspect stays. Values are clamped to the least and
/// greatest of the input around them, so that nothing rings.
struct Resize {
  std::uint32_t max_side = 0;  ///< texels; 0: the image stays as it is
  TexelKind kind = TexelKind::data;
  /// Colours count by their alpha, and texels that become transparent take the colours of their
  /// neighbours.
  bool weigh_alpha = false;
  /// Above 0: as large a part of the texels as before has at least this alpha, of 0 to 1.
  float alpha_cutoff = 0;
  Wrap wrap_u = Wrap::repeat;  ///< across
  Wrap wrap_v = Wrap::repeat;  ///< down

  bool needed(std::uint32_t width, std::uint32_t height) const {
    return max_side != 0 && (width > max_side || height > max_side);
  }
  bool operator==(const Resize&) const = default;
};

enum class EncodedFormat : std::uint8_t { png, jpeg, webp, exr };

struct EncodeOptions {
  /// Lossless WebP: 100 keeps every bit; less lets values differ a little, so that they pack
  /// better: by 2 of 255 at most with 60.
  std::uint32_t near_lossless = 100;
  /// JPEG: colour at half the resolution (4:2:0). What is no colour is spoilt by it.
  bool subsampled = true;
  /// PNG: the greatest effort, several filters tried. JPEG: tables of its own.
  bool smallest = false;
  bool operator==(const EncodeOptions&) const = default;
};

}  // namespace gltfx::codec
