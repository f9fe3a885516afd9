// SPDX-License-Identifier: Apache-2.0
/// The images of a document, for plans that depend on pixels.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>

#include "codec/client.hpp"

namespace gltfx::upgrade {

/// Position of a channel, 0 to 3 for R to A, in the texels of an image; -1: it is alpha, does not
/// exist, and counts as the maximum.
inline int place_of(const codec::Image& image, std::uint8_t channel) {
  constexpr std::uint8_t kAlpha = 3;
  if (channel == kAlpha) return image.has_alpha() ? static_cast<int>(image.channels) - 1 : -1;
  return image.channels < 3 ? 0 : channel;
}

/// An image of a document, as far as it could be read.
struct Picture {
  std::string problem;        ///< why it could not be read, without a full stop; otherwise empty
  codec::Image image;         ///< size, format and statistics; no pixels
  bool alpha_is_red = false;  ///< it has alpha, which equals R in all texels

  /// Of a channel, 0 to 3 for R to A, as returned by a sampler: R, G and B of a grey image are
  /// equal, and a missing alpha is the maximum.
  codec::ChannelStatistics statistics(std::uint8_t channel) const {
    const int place = place_of(image, channel);
    if (place >= 0) return image.statistics[static_cast<std::size_t>(place)];
    return {image.full(), image.full(), 0, image.texels()};
  }
};

/// The images of one document, by index. Returned references are valid as long as this object.
class Pictures {
 public:
  Pictures() = default;
  Pictures(const Pictures&) = delete;
  Pictures& operator=(const Pictures&) = delete;
  virtual ~Pictures() = default;

  virtual const Picture& picture(std::uint64_t image) = 0;
  /// With pixels; null if it cannot be read.
  virtual std::shared_ptr<const codec::Image> pixels(std::uint64_t image) = 0;
  /// An image with the same bytes from an earlier call, otherwise the image itself.
  virtual std::uint64_t same_as(std::uint64_t image) = 0;
};

}  // namespace gltfx::upgrade
