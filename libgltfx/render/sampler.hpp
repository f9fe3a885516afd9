// SPDX-License-Identifier: Apache-2.0
/// A low-discrepancy sampler without state: a number depends on the pixel, the index of the sample
/// and the dimension only, not on the order of calls.
///
/// Owen-scrambled Sobol' points in pairs of dimensions, each pair with its own shuffle of the
/// samples: B. Burley, Practical Hash-based Owen Scrambling (JCGT 2020); hash by N. Vegdahl.
#pragma once

#include <array>
#include <cstdint>

#include "base/lanes.hpp"
#include "render/scene.hpp"

namespace gltfx::render {

/// A well mixed 32-bit number of another one (the finaliser of C. Wellons' "lowbias32").
constexpr std::uint32_t mix_bits(std::uint32_t x) {
  x = (x ^ (x >> 16U)) * 0x7feb352dU;
  x = (x ^ (x >> 15U)) * 0x846ca68bU;
  return x ^ (x >> 16U);
}

constexpr std::uint32_t mix_bits(std::uint32_t a, std::uint32_t b) {
  return mix_bits(a ^ (mix_bits(b) + 0x9e3779b9U + (a << 6U) + (a >> 2U)));
}

/// In [0, 1): the upper 24 bits.
constexpr float unit_float(std::uint32_t bits) { return static_cast<float>(bits >> 8U) * 0x1p-24F; }
inline Lanes unit_float(UintLanes bits) {
  const auto number = reinterpret_cast<IntLanes>(bits >> 8U);
  return __builtin_convertvector(number, Lanes) * 0x1p-24F;
}

/// The bits of each byte in reverse order. `T`: a Number, or lanes of them.
template <class Number, class T = Number>
constexpr T reverse_in_bytes(T x) {
  constexpr Number kOdd = ~Number{0} / 3, kPairs = ~Number{0} / 5, kNibbles = ~Number{0} / 17;
  x = ((x >> 1U) & kOdd) | ((x & kOdd) << 1U);
  x = ((x >> 2U) & kPairs) | ((x & kPairs) << 2U);
  return ((x >> 4U) & kNibbles) | ((x & kNibbles) << 4U);
}

constexpr std::uint32_t reverse_bits(std::uint32_t x) {
  return __builtin_bswap32(reverse_in_bytes<std::uint32_t>(x));
}
constexpr std::uint64_t reverse_bits(std::uint64_t x) {
  return __builtin_bswap64(reverse_in_bytes<std::uint64_t>(x));
}
inline UintLanes reverse_bits(UintLanes x) {
  x = reverse_in_bytes<std::uint32_t>(x);
  x = ((x >> 8U) & 0x00ff00ffU) | ((x & 0x00ff00ffU) << 8U);
  return x >> 16U | x << 16U;
}

/// A random Owen scrambling of a number, or of lanes, whose bits are in reverse order.
template <class T>
constexpr T scramble_reversed(T x, std::uint32_t seed) {
  x ^= x * 0x3d20adeaU;
  x += seed;
  x *= (seed >> 16U) | 1U;
  x ^= x * 0x05526c56U;
  return x ^ (x * 0x53a22864U);
}

/// The second dimension of Sobol's sequence, bits in reverse order: the index as a polynomial in x
/// over the field of two elements, taken at x + 1.
template <class T>
constexpr T second_sobol_reversed(T index) {
  index ^= (index & 0xffff0000U) >> 16U;
  index ^= (index & 0xff00ff00U) >> 8U;
  index ^= (index & 0xf0f0f0f0U) >> 4U;
  index ^= (index & 0xccccccccU) >> 2U;
  return index ^ ((index & 0xaaaaaaaaU) >> 1U);
}

/// The numbers of one sample of one pixel, by dimension: each is drawn at most once, as a pair or
/// as a single number.
class SampleStream {
 public:
  SampleStream() = default;
  /// `pixel`: a number of the pixel; `sample`: from 0 on.
  SampleStream(std::uint32_t seed, std::uint32_t pixel, std::uint32_t sample)
      : key_(mix_bits(pixel, seed)), sample_(sample) {}

  /// A point in [0, 1) x [0, 1).
  Float2 pair(std::uint32_t dimension) const { return pair(dimension, 0, 1); }

  /// One of several points of the dimension, which are stratified all together.
  Float2 pair(std::uint32_t dimension, std::uint32_t part, std::uint32_t parts) const {
    const std::uint32_t seed = mix_bits(key_ + 0x9e3779b9U * (dimension + 1));
    const std::uint32_t index = shuffled(sample_ * parts + part, seed);
    const std::uint32_t first = scramble_reversed(index, mix_bits(seed + 1));
    const std::uint32_t second =
        scramble_reversed(second_sobol_reversed(index), mix_bits(seed + 2));
    const std::uint64_t both = reverse_bits(std::uint64_t{second} << 32U | first);
    return {unit_float(static_cast<std::uint32_t>(both >> 32U)),
            unit_float(static_cast<std::uint32_t>(both))};
  }

  /// The points of the parts from `part` on, for as many as there are lanes: in half the time.
  std::array<Float2, kLanes> pairs(std::uint32_t dimension, std::uint32_t part,
                                   std::uint32_t parts) const {
    const std::uint32_t seed = mix_bits(key_ + 0x9e3779b9U * (dimension + 1));
    const UintLanes index = shuffled(UintLanes{0, 1, 2, 3} + (sample_ * parts + part), seed);
    const Lanes first = unit_float(reverse_bits(scramble_reversed(index, mix_bits(seed + 1))));
    const Lanes second = unit_float(
        reverse_bits(scramble_reversed(second_sobol_reversed(index), mix_bits(seed + 2))));
    return {{{first[0], second[0]},
             {first[1], second[1]},
             {first[2], second[2]},
             {first[3], second[3]}}};
  }

  /// The points of this sample and those after it.
  std::array<Float2, kLanes> following_pairs(std::uint32_t dimension) const {
    return pairs(dimension, 0, 1);
  }
  /// The stream of a later sample of the same pixel.
  SampleStream later(std::uint32_t samples) const {
    SampleStream stream(*this);
    stream.sample_ += samples;
    return stream;
  }

  /// A number in [0, 1), or one of several as above.
  float single(std::uint32_t dimension, std::uint32_t part = 0, std::uint32_t parts = 1) const {
    const std::uint32_t seed = mix_bits(key_ + 0x9e3779b9U * (dimension + 1));
    const std::uint32_t index = shuffled(sample_ * parts + part, seed);
    return unit_float(reverse_bits(scramble_reversed(index, mix_bits(seed + 1))));
  }

  /// The same without stratification, in a third of the time.
  Float2 random_pair(std::uint32_t dimension, std::uint32_t part, std::uint32_t parts) const {
    const std::uint32_t first = hash(dimension, part, parts);
    return {unit_float(first), unit_float(mix_bits(first + 1))};
  }
  float random_single(std::uint32_t dimension, std::uint32_t part, std::uint32_t parts) const {
    return unit_float(hash(dimension, part, parts));
  }

  /// A hash of pixel and sample, for decisions that need no stratification.
  std::uint32_t key() const { return mix_bits(key_, sample_); }

 private:
  std::uint32_t hash(std::uint32_t dimension, std::uint32_t part, std::uint32_t parts) const {
    return mix_bits(mix_bits(key_ + 0x9e3779b9U * (dimension + 1)) ^ (sample_ * parts + part));
  }
  template <class T>
  static T shuffled(T sample, std::uint32_t seed) {
    return reverse_bits(scramble_reversed(reverse_bits(sample), seed));
  }

  std::uint32_t key_ = 0, sample_ = 0;
};

}  // namespace gltfx::render
