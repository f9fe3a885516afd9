// SPDX-License-Identifier: Apache-2.0
#include "uastc_block.hpp"

#include "bit_reader.hpp"
#include "uastc_endpoints.hpp"
#include "uastc_modes.hpp"

namespace gltfx::codec {
namespace {

constexpr Texel kReservedColor{255, 0, 255, 255};

void fill(const Texel& color, const BlockTexels& to) {
  for (std::size_t i = 0; i < kBlockTexels; ++i) to.at(i % kBlockExtent, i / kBlockExtent) = color;
}

// Weights of both planes; equal if there is one.
using Weights = std::array<std::array<std::uint8_t, 2>, kBlockTexels>;

// The highest bit of the first texel of each subset is 0 and is not stored ("anchor indices").
Weights read_weights(BitReader& bits, const UastcMode& mode, UastcPattern pattern) {
  std::array<std::uint8_t, 64> values{};
  for (std::uint32_t i = 0; i < 1U << mode.weight_bits; ++i) {
    values[i] = unquantized_weight(i, mode.weight_bits);
  }
  Weights weights{};
  std::uint32_t met = 0;  // one bit per subset
  for (std::size_t texel = 0; texel < kBlockTexels; ++texel) {
    const std::uint32_t subset = 1U << subset_of(pattern, texel);
    const unsigned count = mode.weight_bits - ((met & subset) == 0 ? 1U : 0U);
    met |= subset;
    weights[texel][0] = values[bits.take(count)];
    weights[texel][1] = mode.planes == 2 ? values[bits.take(count)] : weights[texel][0];
  }
  return weights;
}

// Low and high of R, G, B and A.
using Ends = std::array<std::array<std::uint32_t, 2>, 4>;

// Widened to 16 bits; missing alpha is opaque ("Deriving missing RGBA values").
Ends ends_of(const UastcMode& mode, const UastcEndpoints& values, std::size_t subset) {
  Ends ends{};
  for (std::size_t channel = 0; channel < ends.size(); ++channel) {
    for (std::size_t end = 0; end < 2; ++end) {
      const std::size_t stored =
          mode.channels == 2 ? static_cast<std::size_t>(channel == kAlpha) : channel;
      const std::size_t index = (subset * mode.channels + stored) * 2 + end;
      const std::uint32_t value = stored < mode.channels ? values[index] : 255;
      ends[channel][end] = value << 8U | value;
    }
  }
  return ends;
}

// "Decoding pixel values". `own`: the channel of the second plane.
void interpolate(const std::array<Ends, 3>& ends, const Weights& weights, UastcPattern pattern,
                 std::size_t own, const BlockTexels& to) {
  for (std::size_t i = 0; i < kBlockTexels; ++i) {
    const Ends& subset = ends[subset_of(pattern, i)];
    Texel& texel = to.at(i % kBlockExtent, i / kBlockExtent);
    for (std::size_t channel = 0; channel < texel.size(); ++channel) {
      const std::uint32_t weight = weights[i][channel == own];
      const auto [low, high] = subset[channel];
      texel[channel] =
          static_cast<std::uint8_t>((low * (64 - weight) + high * weight + 32) >> 6U >> 8U);
    }
  }
}

}  // namespace

bool decode_uastc_block(std::span<const std::byte, kUastcBlockBytes> block, const BlockTexels& to) {
  BitReader bits(block);
  const UastcModeCode code = uastc_mode_code(bits.peek(7));
  bits.skip(code.bits);
  if (code.mode == kUastcSolidColor) {
    Texel color{};
    for (std::uint8_t& channel : color) channel = static_cast<std::uint8_t>(bits.take(8));
    fill(color, to);
    return true;
  }
  if (code.mode == kUastcModes) {
    fill(kReservedColor, to);
    return false;
  }
  const UastcMode& mode = uastc_mode(code.mode);
  bits.skip(mode.hint_bits);
  UastcPattern pattern = 0;
  if (mode.subsets > 1) {
    const std::span<const UastcPattern> patterns = uastc_patterns(code.mode);
    const std::size_t index = bits.take(mode.pattern_bits);
    if (index >= patterns.size()) {
      fill(kReservedColor, to);
      return false;
    }
    pattern = patterns[index];
  }
  const std::size_t own = mode.selector_bits > 0 ? bits.take(mode.selector_bits) : kAlpha;
  const UastcEndpoints endpoints = read_uastc_endpoints(bits, mode);
  std::array<Ends, 3> ends{};
  for (std::size_t i = 0; i < mode.subsets; ++i) ends[i] = ends_of(mode, endpoints, i);
  interpolate(ends, read_weights(bits, mode, pattern), pattern, own, to);
  return true;
}

}  // namespace gltfx::codec
