// SPDX-License-Identifier: Apache-2.0
/// Texels of UASTC blocks (Khronos Data Format 1.3, "Universal ASTC", "Decoding process").
///
/// Endpoints are expanded to 16 bits as for linear images, for any transfer function, as in all
/// transcoders to RGBA: hardware that converts sRGB while sampling has another method, whose values
/// differ by at most 1 of 255.
#pragma once

#include <cstddef>
#include <span>

#include "texel.hpp"

namespace gltfx::codec {

inline constexpr std::size_t kUastcBlockBytes = 16;

/// Writes the texels of a block. False for a reserved mode or pattern; then all texels are magenta.
bool decode_uastc_block(std::span<const std::byte, kUastcBlockBytes> block, const BlockTexels& to);

}  // namespace gltfx::codec
