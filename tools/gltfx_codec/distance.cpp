// SPDX-License-Identifier: Apache-2.0
#include "distance.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>

namespace gltfx::codec {
namespace {

constexpr double kOpaque = 255;

class TexelReader {
 public:
  explicit TexelReader(const Texels& texels) : texels_(texels) {}

  bool has_alpha() const { return channels() % 2 == 0; }
  // Red, green, blue and alpha, 0 to 255.
  std::array<double, 4> at(std::uint64_t texel) const {
    const std::uint64_t first = texel * channels();
    std::array<double, 4> values{};
    for (std::uint32_t c = 0; c < 3; ++c) values[c] = number(first + (channels() < 3 ? 0 : c));
    values[3] = has_alpha() ? number(first + channels() - 1) : kOpaque;
    return values;
  }

 private:
  std::uint32_t channels() const { return texels_.raster.channels; }
  double number(std::uint64_t at) const {
    if (texels_.raster.bits == 8) return static_cast<double>(texels_.bytes[at]);
    constexpr double kStep = 257;
    std::uint16_t value = 0;
    std::memcpy(&value, texels_.bytes.data() + at * sizeof value, sizeof value);
    return value / kStep;
  }

  const Texels& texels_;
};

}  // namespace

ImageDistance distance(const Texels& one, const Texels& other) {
  const TexelReader ours(one);
  const TexelReader theirs(other);
  const std::size_t channels = ours.has_alpha() || theirs.has_alpha() ? 4 : 3;
  const std::uint64_t count = std::uint64_t{one.raster.width} * one.raster.height;
  ImageDistance found;
  for (std::uint64_t i = 0; i < count; ++i) {
    const std::array<double, 4> a = ours.at(i);
    const std::array<double, 4> b = theirs.at(i);
    for (std::size_t c = 0; c < channels; ++c) {
      const double off = std::abs(a[c] - b[c]);
      found.greatest = std::max(found.greatest, off);
      found.mean_square += off * off;
    }
  }
  found.mean_square /= static_cast<double>(count * channels);
  return found;
}

}  // namespace gltfx::codec
