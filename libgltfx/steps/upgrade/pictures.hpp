// SPDX-License-Identifier: Apache-2.0
/// What a plan asks about the pixels of a document's images.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>

#include "codec/client.hpp"

namespace gltfx::upgrade {

/// Where a channel, 0 to 3 for R to A, stands in the texels of an image; -1: nowhere, it is alpha
/// and counts as the greatest value.
inline int place_of(const codec::Image& image, std::uint8_t channel) {
  constexpr std::uint8_t kAlpha = 3;
  if (channel == kAlpha) return image.has_alpha() ? static_cast<int>(image.channels) - 1 : -1;
  return image.channels < 3 ? 0 : channel;
}

/// An image of a document, as far as it could be read.
struct Picture {
  std::string problem;        ///< why it could not, a sentence without stop; else empty
  codec::Image image;         ///< its size, form and statistics; no pixels
  bool alpha_is_red = false;  ///< there is an alpha, and in every texel it equals R

  /// Of a channel, 0 to 3 for R to A, as a sampler gives it: a grey image has the same in R, G
  /// and B, one without alpha has the greatest value there.
  codec::ChannelStatistics statistics(std::uint8_t channel) const {
    const int place = place_of(image, channel);
    if (place >= 0) return image.statistics[static_cast<std::size_t>(place)];
    return {image.full(), image.full(), 0, image.texels()};
  }
};

/// The images of one document, by index. References that it gives live as long as it does.
class Pictures {
 public:
  Pictures() = default;
  Pictures(const Pictures&) = delete;
  Pictures& operator=(const Pictures&) = delete;
  virtual ~Pictures() = default;

  virtual const Picture& picture(std::uint64_t image) = 0;
  /// With its pixels; null when it cannot be read.
  virtual std::shared_ptr<const codec::Image> pixels(std::uint64_t image) = 0;
  /// An image with the same bytes that was asked about before, else the image itself.
  virtual std::uint64_t same_as(std::uint64_t image) = 0;
};

}  // namespace gltfx::upgrade
