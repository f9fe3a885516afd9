// SPDX-License-Identifier: Apache-2.0
/// The sources of the texels of a new image. Pure data.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

namespace gltfx::upgrade {

/// One channel: offset + scale * channel of an image of the document, clamped to 0 .. 1. Numbers
/// are encoded values, with 1 for the maximum of a depth; colour spaces are not converted. An image
/// without alpha has 1 there, a grey image has equal R, G and B.
struct ChannelSource {
  std::optional<std::uint64_t> image;  ///< index into the root's images; none: `offset` everywhere
  std::uint8_t channel = 0;            ///< 0 to 3 for R, G, B, A
  double scale = 1;
  double offset = 0;
  bool operator==(const ChannelSource&) const = default;

  static ChannelSource constant(double value) { return {std::nullopt, 0, 0, value}; }
  static ChannelSource of(std::uint64_t from, std::uint8_t which, double times = 1,
                          double plus = 0) {
    return {from, which, times, plus};
  }
};

/// A new image, by channels R, G, B, A. It is a PNG, RGB if A is 1 everywhere and otherwise RGBA,
/// with 16 bits if a source image has 16 bits. An integer n of a channel becomes round(offset *
/// full) + round(scale * n), halves away from 0, so that offset 0 and scale 1 keep all bits. The
/// source images have the same size.
struct ImageJob {
  std::array<ChannelSource, 4> channels;
  bool operator==(const ImageJob&) const = default;

  /// The first source image, which gives the name of the new one. Precondition: there is one.
  std::uint64_t first_image() const {
    for (const ChannelSource& channel : channels) {
      if (channel.image) return *channel.image;
    }
    return 0;
  }
};

}  // namespace gltfx::upgrade
