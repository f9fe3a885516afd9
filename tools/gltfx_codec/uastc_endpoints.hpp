// SPDX-License-Identifier: Apache-2.0
/// Endpoint values of a UASTC block ("Extracting endpoints", "Unquantizing endpoints").
#pragma once

#include <array>
#include <cstdint>

#include "bit_reader.hpp"
#include "uastc_modes.hpp"

namespace gltfx::codec {

inline constexpr std::size_t kMostEndpointValues = 18;

/// 0 to 255, low and high of each channel of each subset.
using UastcEndpoints = std::array<std::uint8_t, kMostEndpointValues>;

/// The packed digits of values: at most five trits or three quints as one number ("Unpacking
/// Trits", "Unpacking Quints"); bits of a group by the number of its digits.
inline constexpr std::array<unsigned, 6> kTritBits{0, 2, 4, 5, 7, 8};
inline constexpr std::array<unsigned, 4> kQuintBits{0, 3, 5, 7};

/// From a digit and bits to 0..255 ("ASTC Endpoint Unquantization"), for the depths that modes use.
std::uint8_t unquantized_endpoint(Digits digits, unsigned depth, std::uint32_t digit,
                                  std::uint32_t value);

/// Reads the first mode.endpoint_values().
UastcEndpoints read_uastc_endpoints(BitReader& bits, const UastcMode& mode);

}  // namespace gltfx::codec
