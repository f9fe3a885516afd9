// SPDX-License-Identifier: Apache-2.0
/// The textures of materials: which coordinates they read, and how large they are.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "measure/source.hpp"
#include "model/material.hpp"
#include "model/texture.hpp"

namespace gltfx::measure {

/// A texture that a material reads.
struct TextureUse {
  std::string slot;  ///< "normalTexture"
  model::TextureSlot read;
};

/// What a material reads.
struct MaterialTextures {
  std::vector<TextureUse> uses;   ///< with a texture each, those of extensions included
  model::TextureSlot base_color;  ///< may have no texture
  std::array<float, 4> base_color_factor{1, 1, 1, 1};

  /// The texture in that slot, or null. An empty name is that of the base color.
  const model::TextureSlot* find(std::string_view slot) const;
  /// The n of TEXCOORD_n: of the base color, else the least one, else 0.
  std::uint32_t uv_set() const;
};

/// By material. Linear in the slots.
std::vector<MaterialTextures> material_textures(const Source& source);

/// The size of a texture, by the header of its first image that has one.
struct TextureSize {
  std::uint32_t width = 0, height = 0;  ///< texels
  model::Sampler sampler;
};
/// Nothing: no header could be read.
std::optional<TextureSize> size_of_texture(const Source& source, std::uint32_t texture);

}  // namespace gltfx::measure
