// SPDX-License-Identifier: Apache-2.0
#include "codec/statistics.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace gltfx::codec {
namespace {

constexpr float kNotUnit = 0.1F;
constexpr float kFarOff = 0.3F;
constexpr float kInward = -2.0F / 255;

}  // namespace

Statistics::Statistics(const Image& image, bool normals)
    : channels_(image.channels),
      full_(image.full()),
      with_normals_(normals && image.channels >= 3) {
  for (ChannelStatistics& channel : channel_) channel.least = full_;
}

void Statistics::add(std::span<const std::byte> texels) {
  if (full_ == 255) {
    add_texels(reinterpret_cast<const std::uint8_t*>(texels.data()), texels.size());
  } else {
    add_texels(reinterpret_cast<const std::uint16_t*>(texels.data()), texels.size() / 2);
  }
}

void Statistics::note(std::size_t channel, std::uint32_t least, std::uint32_t greatest) {
  channel_[channel].least = std::min(channel_[channel].least, least);
  channel_[channel].greatest = std::max(channel_[channel].greatest, greatest);
}

// Adjacent lanes become vector instructions if there is no branch and no reference (std::min) in
// the loop; counters are as wide as the values, so they are read before they overflow.
template <typename T>
void Statistics::add_texels(const T* values, std::size_t count) {
  constexpr T kFull = std::numeric_limits<T>::max();
  if (with_normals_) add_normals(values, count);
  std::size_t at = 0;
  // The comparison with the neighbour reads one value ahead.
  while (count - at > kLanes) {
    const std::size_t steps = std::min<std::size_t>((count - at - 1) / kLanes, 255);
    std::array<T, kLanes> least, greatest, zeros{}, fulls{}, differences{};
    least.fill(kFull);
    greatest.fill(0);
    for (std::size_t step = 0; step < steps; ++step, at += kLanes) {
      for (std::size_t lane = 0; lane < kLanes; ++lane) {
        const T value = values[at + lane];
        least[lane] = value < least[lane] ? value : least[lane];
        greatest[lane] = value > greatest[lane] ? value : greatest[lane];
        zeros[lane] = static_cast<T>(zeros[lane] + static_cast<T>(value == 0));
        fulls[lane] = static_cast<T>(fulls[lane] + static_cast<T>(value == kFull));
        differences[lane] = static_cast<T>(differences[lane] | (value ^ values[at + lane + 1]));
      }
    }
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      const std::size_t channel = lane % channels_;
      note(channel, least[lane], greatest[lane]);
      channel_[channel].zeros += zeros[lane];
      channel_[channel].fulls += fulls[lane];
      if (channels_ >= 3 && channel < 2 && differences[lane] != 0) grey_ = false;
    }
  }
  add_rest(values + at, count - at);
}

template <typename T>
void Statistics::add_rest(const T* values, std::size_t count) {
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t channel = i % channels_;
    note(channel, values[i], values[i]);
    if (values[i] == 0) ++channel_[channel].zeros;
    if (values[i] == full_) ++channel_[channel].fulls;
    if (channels_ >= 3 && channel < 2 && values[i] != values[i + 1]) grey_ = false;
  }
}

// In blocks: first the vectors are extracted from the texels, then they are measured with vector
// instructions, which need adjacent numbers of the same type.
template <typename T>
void Statistics::add_normals(const T* values, std::size_t count) {
  const float scale = 2.0F / static_cast<float>(std::numeric_limits<T>::max());
  const std::size_t texels = count / channels_;
  std::array<float, kBlock> x, y, z;
  for (std::size_t first = 0; first < texels; first += kBlock) {
    const std::size_t size = std::min(kBlock, texels - first);
    const T* from = values + first * channels_;
    for (std::size_t i = 0; i < size; ++i, from += channels_) {
      x[i] = static_cast<float>(from[0]) * scale - 1;
      y[i] = static_cast<float>(from[1]) * scale - 1;
      z[i] = static_cast<float>(from[2]) * scale - 1;
    }
    measure({x, y, z}, size);
  }
}

void Statistics::measure(const Vectors& vectors, std::size_t count) {
  float sum = 0;
  float steepest = 0;
  int seen = 0, not_unit = 0, far_off = 0, inward = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const float x = vectors.x[i], y = vectors.y[i], z = vectors.z[i];
    const float length = std::sqrt(x * x + y * y + z * z);
    const float off = std::abs(length - 1);
    const bool vector = x != y || x != z;  // grey is the padding between charts
    seen += vector ? 1 : 0;
    not_unit += vector && off > kNotUnit ? 1 : 0;
    far_off += vector && off > kFarOff ? 1 : 0;
    inward += vector && z < kInward ? 1 : 0;
    sum += vector ? length : 0;
    steepest = std::max(steepest, vector ? std::max(std::abs(x), std::abs(y)) : 0);
  }
  vectors_ += static_cast<std::uint64_t>(seen);
  not_unit_ += static_cast<std::uint64_t>(not_unit);
  far_off_ += static_cast<std::uint64_t>(far_off);
  inward_ += static_cast<std::uint64_t>(inward);
  length_sum_ += static_cast<double>(sum);
  steepest_ = std::max(steepest_, steepest);
}

void Statistics::finish(Image& image) const {
  image.grey = grey_;
  for (std::size_t i = 0; i < channels_; ++i) image.statistics[i] = channel_[i];
  if (!with_normals_) return;
  const auto vectors = static_cast<double>(std::max<std::uint64_t>(vectors_, 1));
  image.normals = {vectors_,
                   not_unit_,
                   far_off_,
                   inward_,
                   length_sum_ / vectors,
                   std::min(1.0, static_cast<double>(steepest_))};
}

}  // namespace gltfx::codec
