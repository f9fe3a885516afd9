// SPDX-License-Identifier: Apache-2.0
#include "uastc_endpoints.hpp"

#include <algorithm>

namespace gltfx::codec {
namespace {

using DigitsOfValues = std::array<std::uint8_t, kMostEndpointValues>;

DigitsOfValues read_digits(BitReader& bits, Digits digits, std::size_t count) {
  DigitsOfValues values{};
  if (digits == Digits::none) return values;
  const bool trits = digits == Digits::trits;
  const std::size_t most = trits ? 5 : 3;
  const std::uint32_t base = trits ? 3 : 5;
  for (std::size_t first = 0; first < count; first += most) {
    const std::size_t group = std::min(most, count - first);
    std::uint32_t packed = bits.take(trits ? kTritBits[group] : kQuintBits[group]);
    for (std::size_t i = first; i < first + group; ++i, packed /= base) {
      values[i] = static_cast<std::uint8_t>(packed % base);
    }
  }
  return values;
}

// The factor C of a digit, and the bits above the lowest one, spread over nine bits ("ASTC Endpoint
// Unquantization"), for the used depths.
struct Spread {
  std::uint32_t factor, bits;
};
Spread spread_of(Digits digits, unsigned depth, std::uint32_t value) {
  const std::uint32_t high = value >> 1U;  // from b upwards
  if (digits == Digits::quints) {
    return depth == 3 ? Spread{26, high << 7U | high << 1U | high >> 1U}  // cb0000cbc
                      : Spread{6, high << 5U | high >> 3U};               // edcb0000e
  }
  switch (depth) {
    case 2:
      return {93, high << 8U | high << 4U | high << 2U | high << 1U};  // b000b0bb0
    case 4:
      return {22, high << 6U | high};  // dcb000dcb
    default:
      return {5, high << 4U | high >> 4U};  // fedcb000f
  }
}

}  // namespace

std::uint8_t unquantized_endpoint(Digits digits, unsigned depth, std::uint32_t digit,
                                  std::uint32_t value) {
  if (digits == Digits::none) {
    // Repeated to eight bits.
    const std::uint32_t twice = value << depth | value;
    return static_cast<std::uint8_t>(depth == 8 ? value : twice << 8U >> (2 * depth));
  }
  const std::uint32_t lowest = (value & 1U) != 0 ? 0x1FF : 0;
  const Spread spread = spread_of(digits, depth, value);
  const std::uint32_t sum = (digit * spread.factor + spread.bits) ^ lowest;
  return static_cast<std::uint8_t>((lowest & 0x80U) | sum >> 2U);
}

UastcEndpoints read_uastc_endpoints(BitReader& bits, const UastcMode& mode) {
  const std::size_t count = mode.endpoint_values();
  const DigitsOfValues digits = read_digits(bits, mode.digits, count);
  UastcEndpoints endpoints{};
  for (std::size_t i = 0; i < count; ++i) {
    endpoints[i] = unquantized_endpoint(mode.digits, mode.endpoint_bits, digits[i],
                                        bits.take(mode.endpoint_bits));
  }
  return endpoints;
}

}  // namespace gltfx::codec
