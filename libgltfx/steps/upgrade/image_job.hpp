// SPDX-License-Identifier: Apache-2.0
/// What the texels of a new image are made of. Pure data.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

namespace gltfx::upgrade {

/// One channel: offset + scale * channel of an image of the document, cut to 0 .. 1. Numbers are
/// encoded values, 1 for the greatest of a depth; nothing is converted between colour spaces. An
/// image without alpha has 1 there, a grey one the same in R, G and B.
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

/// A new image, by channels R, G, B, A. It is a PNG, RGB where A is 1 everywhere and else RGBA, of
/// 16 bits where an image that it is made of has them. A whole number n of a channel becomes
/// round(offset * full) + round(scale * n), halves away from 0, so that offset 0 and scale 1 keep
/// every bit. Images that it is made of have the same size.
struct ImageJob {
  std::array<ChannelSource, 4> channels;
  bool operator==(const ImageJob&) const = default;

  /// The first image it is made of: names the new one. Precondition: there is one.
  std::uint64_t first_image() const {
    for (const ChannelSource& channel : channels) {
      if (channel.image) return *channel.image;
    }
    return 0;
  }
};

}  // namespace gltfx::upgrade
