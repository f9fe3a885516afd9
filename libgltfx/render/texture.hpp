// SPDX-License-Identifier: Apache-2.0
/// Reading textures.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

#include "render/scene.hpp"

namespace gltfx::render {

/// The texels around a point of a texture, and their weights.
struct TexelPatch {
  std::array<std::size_t, 4> texels{};
  std::array<float, 4> weights{};
};

/// At (u, v) of the texture's own coordinates, wrapped. Coordinates that are not finite give the
/// texel at (0, 0). The same for all textures of the same size, wrapping and filter. Precondition:
/// the texture is not `missing`.
TexelPatch patch_at(const Texture& texture, const Float2& uv);

/// The texture at `patch`: sRGB, if requested, is decoded before filtering. Missing channels: grey
/// gives all colours, alpha is 1.
Float4 sample_texture(const Texture& texture, const TexelPatch& patch, bool srgb);

/// One channel at `patch`, linear: 0 to 3 for R, G, B, A.
float sample_channel(const Texture& texture, const TexelPatch& patch, std::uint32_t channel);

/// The same at (u, v), where a texture that is `missing` shows a marked checker or reads 1.
Float4 sample_texture(const Texture& texture, float u, float v, bool srgb);
float sample_channel(const Texture& texture, float u, float v, std::uint32_t channel);

/// TextureUse::transform. The text of KHR_texture_transform contradicts itself: its text and its
/// example rotate coordinates counter-clockwise as seen, with v running down the image; its GLSL
/// code rotates them clockwise. This follows text and example, as other renderers do.
inline std::array<Float3, 2> texture_transform(const Float2& offset, float rotation,
                                               const Float2& scale) {
  const float sine = std::sin(rotation);
  const float cosine = std::cos(rotation);
  const auto& [x, y] = scale;
  return {{{cosine * x, sine * y, offset[0]}, {-sine * x, cosine * y, offset[1]}}};
}

/// Transforms the coordinates of a set to those of a texture use.
inline Float2 transform_uv(const TextureUse& use, const Float2& uv) {
  const auto& m = use.transform;
  return {m[0][0] * uv[0] + m[0][1] * uv[1] + m[0][2], m[1][0] * uv[0] + m[1][1] * uv[1] + m[1][2]};
}

}  // namespace gltfx::render
