// SPDX-License-Identifier: Apache-2.0
#include "basis_etc1s.hpp"

#include <algorithm>

namespace gltfx::codec {
namespace {

// One channel of a block by the value of a selector, from dark to bright.
using Steps = std::array<std::uint8_t, 4>;
Steps steps_of(const Etc1sEndpoint& endpoint, std::size_t channel) {
  const int base = endpoint.color[channel] << 3 | endpoint.color[channel] >> 2;
  const auto [small, large] = kEtc1Modifiers[endpoint.modifiers];
  const auto moved = [base](int by) {
    return static_cast<std::uint8_t>(std::clamp(base + by, 0, 255));
  };
  return {moved(-large), moved(-small), moved(small), moved(large)};
}

template <typename Write>
void for_each_texel(const Etc1sSelector& selector, const Write& write) {
  for (std::size_t y = 0; y < kBlockExtent; ++y) {
    for (std::size_t x = 0; x < kBlockExtent; ++x) write(x, y, selector[y] >> (2 * x) & 3U);
  }
}

}  // namespace

void write_etc1s_colors(const Etc1sEndpoint& endpoint, const Etc1sSelector& selector,
                        const BlockTexels& to) {
  const Steps red = steps_of(endpoint, 0), green = steps_of(endpoint, 1),
              blue = steps_of(endpoint, 2);
  for_each_texel(selector, [&](std::size_t x, std::size_t y, std::size_t step) {
    Texel& texel = to.at(x, y);
    texel[0] = red[step];
    texel[1] = green[step];
    texel[2] = blue[step];
  });
}

void write_etc1s_channel(const Etc1sEndpoint& endpoint, const Etc1sSelector& selector,
                         std::size_t channel, const BlockTexels& to) {
  // The three channels are equal; readers take G.
  const Steps steps = steps_of(endpoint, 1);
  for_each_texel(selector, [&](std::size_t x, std::size_t y, std::size_t step) {
    to.at(x, y)[channel] = steps[step];
  });
}

}  // namespace gltfx::codec
