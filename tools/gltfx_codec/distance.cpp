// SPDX-License-Identifier: Apache-2.0
#include "distance.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <vector>

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

// Degrees between the vectors 2c - 1; 0 if one of them has no direction.
double angle_between(const std::array<double, 4>& a, const std::array<double, 4>& b) {
  double product = 0;
  double square_of_a = 0;
  double square_of_b = 0;
  for (std::size_t c = 0; c < 3; ++c) {
    const double x = a[c] / 127.5 - 1;
    const double y = b[c] / 127.5 - 1;
    product += x * y;
    square_of_a += x * x;
    square_of_b += y * y;
  }
  const double length = std::sqrt(square_of_a * square_of_b);
  if (length <= 0) return 0;
  constexpr double kDegrees = 57.29577951308232;
  return std::acos(std::clamp(product / length, -1.0, 1.0)) * kDegrees;
}

// Counts angles in steps of a hundredth of a degree.
class Angles {
 public:
  void add(double degrees) {
    ++counts_[static_cast<std::size_t>(degrees * kSteps)];
    ++count_;
  }
  // The angle that 99 % do not exceed, rounded up.
  double nearly_greatest() const {
    std::uint64_t left = count_ / 100;
    std::size_t step = counts_.size() - 1;
    while (step > 0 && counts_[step] <= left) left -= counts_[step--];
    return std::min(static_cast<double>(step + 1) / kSteps, kMost);
  }

 private:
  static constexpr double kSteps = 100;
  static constexpr double kMost = 180;
  std::vector<std::uint64_t> counts_ = std::vector<std::uint64_t>(18001);
  std::uint64_t count_ = 0;
};

}  // namespace

ImageDistance distance(const Texels& one, const Texels& other, TexelKind kind) {
  const TexelReader ours(one);
  const TexelReader theirs(other);
  const std::size_t channels = ours.has_alpha() || theirs.has_alpha() ? 4 : 3;
  const std::uint64_t count = std::uint64_t{one.raster.width} * one.raster.height;
  ImageDistance found;
  Angles angles;
  for (std::uint64_t i = 0; i < count; ++i) {
    const std::array<double, 4> a = ours.at(i);
    const std::array<double, 4> b = theirs.at(i);
    for (std::size_t c = 0; c < channels; ++c) {
      const double off = std::abs(a[c] - b[c]);
      found.greatest = std::max(found.greatest, off);
      found.mean_square += off * off;
    }
    if (kind == TexelKind::normal) angles.add(angle_between(a, b));
  }
  if (kind == TexelKind::normal) found.angle = angles.nearly_greatest();
  found.mean_square /= static_cast<double>(count * channels);
  return found;
}

}  // namespace gltfx::codec
