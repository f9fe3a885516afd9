// SPDX-License-Identifier: Apache-2.0
/// Reading textures.
#pragma once

#include "bake/scene.hpp"

namespace gltfx::bake {

/// The texture at (u, v) of its own coordinates: wrapped, filtered, sRGB decoded where asked for
/// before filtering. Missing channels: grey stands for all colours, alpha is 1. Coordinates
/// that are not finite read the texel at (0, 0).
Float4 sample_texture(const Texture& texture, float u, float v, bool srgb);

/// One channel of a texture, linear: 0 to 3 for R, G, B, A.
float sample_channel(const Texture& texture, float u, float v, std::uint32_t channel);

/// Transforms the coordinates of a set to those of a texture use.
inline Float2 transform_uv(const TextureUse& use, const Float2& uv) {
  const auto& m = use.transform;
  return {m[0][0] * uv[0] + m[0][1] * uv[1] + m[0][2], m[1][0] * uv[0] + m[1][1] * uv[1] + m[1][2]};
}

}  // namespace gltfx::bake
