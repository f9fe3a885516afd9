// SPDX-License-Identifier: Apache-2.0
/// The modes and patterns of UASTC blocks (Khronos Data Format 1.3, "Universal ASTC").
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace gltfx::codec {

/// Digits of endpoint values in addition to bits.
enum class Digits : std::uint8_t { none, trits, quints };

/// Hints without some for BC1 and ETC1.
inline constexpr std::uint8_t kFewHintBits = 17;

/// The layout of a block of one mode: hints for other formats, pattern, selector of a channel,
/// endpoints, weights.
struct UastcMode {
  std::uint8_t hint_bits = 0;
  std::uint8_t subsets = 1;
  std::uint8_t channels = 3;  ///< 2: luminance and alpha
  std::uint8_t planes = 1;    ///< 2: one channel has separate weights
  std::uint8_t weight_bits = 0;
  std::uint8_t endpoint_bits = 0;
  Digits digits = Digits::none;
  std::uint8_t pattern_bits = 0;
  std::uint8_t selector_bits = 0;  ///< for the channel with separate weights; 0: alpha

  /// Whether the hints have two bits for BC1 and a bias for ETC1, not one bit and no bias.
  bool has_etc1_bias() const { return hint_bits != kFewHintBits; }
  std::size_t endpoint_values() const { return std::size_t{2} * channels * subsets; }
};

inline constexpr std::size_t kUastcModes = 19;
inline constexpr std::size_t kUastcSolidColor = 8;

struct UastcModeCode {
  std::uint8_t mode = kUastcModes;  ///< kUastcModes: reserved
  std::uint8_t bits = 0;
};

/// The mode of a block by its first seven bits, the first one lowest ("Mode Index").
UastcModeCode uastc_mode_code(std::uint32_t bits);

/// The first bits of a block of a mode, the first one lowest.
struct UastcPrefix {
  std::uint8_t value = 0, bits = 0;
};
UastcPrefix uastc_prefix(std::size_t mode);

/// Precondition: a mode with weights, so neither kUastcSolidColor nor reserved.
const UastcMode& uastc_mode(std::size_t index);

/// The subset of each texel, two bits each, the upper left one lowest; 0 for one subset.
using UastcPattern = std::uint32_t;

constexpr std::size_t subset_of(UastcPattern pattern, std::size_t texel) {
  return pattern >> 2 * texel & 3U;
}

/// The patterns of a mode with more than one subset.
std::span<const UastcPattern> uastc_patterns(std::size_t mode);

/// A weight of 1 to 5 bits as 0 to 64 ("Unquantizing weights").
std::uint8_t unquantized_weight(std::uint32_t value, unsigned bits);

}  // namespace gltfx::codec
