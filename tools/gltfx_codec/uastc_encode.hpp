// SPDX-License-Identifier: Apache-2.0
/// Encodes blocks as UASTC (Khronos Data Format 1.3, "Universal ASTC").
#pragma once

#include <cstddef>
#include <span>

#include "texel.hpp"
#include "uastc_block.hpp"

namespace gltfx::codec {

/// Writes a block of texels, in rows from the top, with a small squared error over all channels: a
/// block of one colour is exact. Equal texels give equal bytes.
void encode_uastc_block(std::span<const Texel, 16> texels,
                        std::span<std::byte, kUastcBlockBytes> to);

}  // namespace gltfx::codec
