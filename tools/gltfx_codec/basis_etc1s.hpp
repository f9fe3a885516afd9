// SPDX-License-Identifier: Apache-2.0
/// Texels of ETC1S blocks (Khronos Data Format 1.3, "ETC1S").
#pragma once

#include <array>

#include "basis_codebooks.hpp"
#include "texel.hpp"

namespace gltfx::codec {

/// "Intensity modifier sets": the smaller and the larger one.
inline constexpr std::array<std::array<int, 2>, 8> kEtc1Modifiers{
    {{2, 8}, {5, 17}, {9, 29}, {13, 42}, {18, 60}, {24, 80}, {33, 106}, {47, 183}}};

/// Writes R, G and B of a block; A does not change.
void write_etc1s_colors(const Etc1sEndpoint& endpoint, const Etc1sSelector& selector,
                        const BlockTexels& to);

/// Writes one channel of a block with a grey colour; the other channels do not change.
void write_etc1s_channel(const Etc1sEndpoint& endpoint, const Etc1sSelector& selector,
                         std::size_t channel, const BlockTexels& to);

}  // namespace gltfx::codec
