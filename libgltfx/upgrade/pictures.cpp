// SPDX-License-Identifier: Apache-2.0
#include "upgrade/pictures.hpp"

namespace gltfx::upgrade {

int place_of(const codec::Image& image, std::uint8_t channel) {
  constexpr std::uint8_t kAlpha = 3;
  if (channel == kAlpha) return image.has_alpha() ? static_cast<int>(image.channels) - 1 : -1;
  return image.channels < 3 ? 0 : channel;
}

codec::ChannelStatistics Picture::statistics(std::uint8_t channel) const {
  const int place = place_of(image, channel);
  if (place >= 0) return image.statistics[static_cast<std::size_t>(place)];
  return {image.full(), image.full(), 0, image.texels()};
}

}  // namespace gltfx::upgrade
