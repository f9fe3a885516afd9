// SPDX-License-Identifier: Apache-2.0
/// Hints in UASTC blocks, with which transcoders make ETC1 and ETC2 blocks without a search.
#pragma once

#include <cstdint>
#include <span>

#include "bit_writer.hpp"
#include "texel.hpp"
#include "uastc_modes.hpp"

namespace gltfx::codec {

/// Writes mode.hint_bits bits. The hints for BC1 are 0: transcoders then search for the best block.
void write_uastc_hints(std::span<const Texel, 16> texels, const UastcMode& mode, BitWriter& bits);

/// Writes the hints of a block of one colour, an ETC1 colour near it.
void write_solid_hints(const Texel& color, BitWriter& bits);

}  // namespace gltfx::codec
