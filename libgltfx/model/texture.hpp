// SPDX-License-Identifier: Apache-2.0
/// Textures, their samplers, and the slots of materials that refer to them (specification sections
/// 3.8 and 5.30).
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "model/asset.hpp"
#include "model/properties.hpp"

namespace gltfx::model {

enum class Wrap : std::uint8_t { repeat, clamp_to_edge, mirrored_repeat };
enum class Filter : std::uint8_t { nearest, linear };

/// How a texture is read. The default, which the specification leaves to the renderer, is linear
/// with mipmaps.
struct Sampler {
  Wrap wrap_s = Wrap::repeat;
  Wrap wrap_t = Wrap::repeat;
  Filter magnify = Filter::linear;
  Filter minify = Filter::linear;
  bool mipmaps = true;
  Filter between_mipmaps = Filter::linear;
  bool operator==(const Sampler&) const = default;
};

/// One texture. Several images are the same picture in different formats, for different readers.
struct Texture {
  std::vector<std::uint32_t> images;  ///< indices of objects; those of extensions first
  Sampler sampler;
};

Texture read_texture(const Asset& asset, json::NodeId object);

/// A use of a texture by a material.
struct TextureSlot {
  std::optional<std::uint32_t> texture;  ///< index of an object
  std::uint32_t tex_coord = 0;           ///< the n of TEXCOORD_n
  /// KHR_texture_transform: coordinates are scaled first, then rotated about the origin (radians,
  /// counter-clockwise), then translated.
  std::array<float, 2> offset{0, 0};
  float rotation = 0;
  std::array<float, 2> scale{1, 1};
  bool operator==(const TextureSlot&) const = default;
};

/// Whether a slot is a normal map, judged by its name: schema files do not state it.
bool is_normal_map(std::string_view slot);

/// The slot in the member `name`, without a texture when there is none.
TextureSlot read_slot(const Asset& asset, const Properties& owner, std::string_view name);

}  // namespace gltfx::model
