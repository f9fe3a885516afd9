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

/// Reads the first mode.endpoint_values().
UastcEndpoints read_uastc_endpoints(BitReader& bits, const UastcMode& mode);

}  // namespace gltfx::codec
