// SPDX-License-Identifier: Apache-2.0
/// The scene: plain data, independent of the file format. Its producer has checked it: every index
/// is in range. Right-handed, y up, metres, linear colours (Rec. 709).
#pragma once

#include <gltfx/material.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "base/material_table.hpp"
#include "base/packed.hpp"
#include "base/shared_array.hpp"

namespace gltfx::render {

/// Three rows of an affine transform of column vectors: linear part left, translation right.
using Matrix34 = std::array<Float4, 3>;
inline constexpr Matrix34 kIdentity{{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}}};

inline constexpr std::uint32_t kNone = 0xFFFFFFFFU;

/// How a texture is read outside of [0, 1] (specification section 5.25).
enum class Wrap : std::uint8_t { repeat, mirrored_repeat, clamp_to_edge };
enum class Filter : std::uint8_t { linear, nearest };

/// An image with the sampler of one texture. Texels are as decoded: no colour conversion, alpha not
/// premultiplied.
struct Texture {
  std::uint32_t width = 0, height = 0;  ///< texels; at least 1 unless `missing`
  std::uint32_t channels = 0;           ///< 1 grey, 2 grey and alpha, 3 RGB, 4 RGBA
  std::uint32_t bits = 8;               ///< of each channel: 8, or 16 in the machine's byte order
  std::span<const std::byte> pixels;    ///< rows from the top, packed
  std::shared_ptr<const void> owner;    ///< of `pixels`
  Wrap wrap_s = Wrap::repeat, wrap_t = Wrap::repeat;
  /// For magnification; between the levels of a mipmap samples are spread over the pixel instead.
  Filter filter = Filter::linear;
  /// Its image is not available: colours are drawn as a marked checker, other channels read 1.
  bool missing = false;
};

enum class AlphaMode : std::uint8_t { opaque, mask, blend };

/// Texture slots of a material. The slot decides channels and colour space.
using Slot = MaterialSlot;
/// Contents of the texels of a slot.
constexpr const SlotReading& reading(Slot slot) {
  return material_table::kReadings[static_cast<std::size_t>(slot)];
}

/// One use of a texture by a material.
struct TextureUse {
  Slot slot{};
  std::uint32_t texture = kNone;  ///< index in Scene::textures
  std::uint32_t uv_set = 0;       ///< TEXCOORD_n; one that the mesh lacks reads (0, 0)
  /// Rows of the affine transform of (u, v, 1) that KHR_texture_transform describes.
  std::array<Float3, 2> transform{{{1, 0, 0}, {0, 1, 0}}};
  /// The channel, 0 to 3, for slots that read one; kNone: that of the slot.
  std::uint32_t channel = kNone;
};

inline const TextureUse kNoTexture{};

/// A material of the asset: its factors, and the textures that scale them. It has many members
/// because they are the properties of glTF that are not in Material.
struct SceneMaterial {
  std::string name;
  /// Factors, named as in the specification. For specular-glossiness the base colour is the diffuse
  /// factor. The thickness of iridescence is the maximum.
  Material factors;
  float alpha = 1;              ///< of the base colour factor
  float emissive_strength = 1;  ///< factors.emissive is multiplied by it already
  AlphaMode alpha_mode = AlphaMode::opaque;
  float alpha_cutoff = 0.5F;
  bool double_sided = false;
  float normal_scale = 1, clearcoat_normal_scale = 1;
  float iridescence_thickness_minimum = 100;  ///< nanometres

  /// KHR_materials_pbrSpecularGlossiness: these members replace metalness, roughness,
  /// specular (whose slots have no texture then) and index of refraction.
  bool specular_glossiness = false;
  Float3 f0{1, 1, 1};
  float glossiness = 1;

  /// Toon shading in two tones: the base color where it is lit, this one elsewhere.
  bool toon = false;
  Float3 shade_color{1, 1, 1};

  /// The first generation of KHR_materials_translucency: factors.diffuse_transmission is its
  /// factor, and transmitted light is tinted by the base colour.
  bool tinted_by_base_color = false;

  /// The slots in use, in any order, and by slot the position of its use plus 1, or 0: few slots
  /// have a texture, and an asset may have a hundred thousand materials.
  std::vector<TextureUse> textures;
  std::array<std::uint8_t, kMaterialSlots> places{};

  /// For writing: adds the use of the slot if there is none.
  TextureUse& use(Slot slot);
  /// A use with texture kNone for a slot without one.
  const TextureUse& use(Slot slot) const {
    const std::uint8_t place = places[static_cast<std::size_t>(slot)];
    return place == 0 ? kNoTexture : textures[place - 1];
  }
};

inline TextureUse& SceneMaterial::use(Slot slot) {
  std::uint8_t& place = places[static_cast<std::size_t>(slot)];
  if (place == 0) {
    textures.push_back({slot});
    place = static_cast<std::uint8_t>(textures.size());
  }
  return textures[place - 1U];
}

/// The member that holds a parameter, by name.
using ParameterMember = std::variant<double Material::*, Rgb Material::*, float SceneMaterial::*,
                                     Float3 SceneMaterial::*>;
inline constexpr auto kParameterMembers =
    material_members<ParameterMember, Material, SceneMaterial>();

/// Triangles with one material, posed: skinned and morphed. Attributes are by vertex, and empty if
/// the asset has none. Points and lines are markers (markers.hpp). Meshes that differ in their
/// material only share the arrays.
struct Mesh {
  SharedArray<std::array<std::uint32_t, 3>> triangles;  ///< counter-clockwise seen from the front
  SharedArray<Float3> positions;
  /// Empty: flat, and tangents are ignored. Need not be of unit length.
  SharedArray<Float3> normals;
  SharedArray<Float4> tangents;          ///< w is the sign of the bitangent
  SharedArray<std::vector<Float2>> uvs;  ///< by number of the set
  SharedArray<Float4> colors;            ///< linear, factors of the base colour
  std::uint32_t material = kNone;        ///< index in Scene::materials; kNone: the default one
  /// Of markers that have no size yet: unit vectors from the point or line to their surface.
  SharedArray<Float3> marker_directions;
  bool unlit = false;  ///< shows base colour and emission, independent of the material
};

/// Meshes with one transform: `count` of them from `mesh` on. Instances that begin with the same
/// mesh have the same count.
struct Instance {
  std::uint32_t mesh = 0;
  Matrix34 to_world = kIdentity;  ///< may mirror, and may be singular
  std::uint32_t count = 1;
};

/// A punctual light in the world (KHR_lights_punctual).
struct Light {
  enum class Kind : std::uint8_t { directional, point, spot };
  Kind kind = Kind::point;
  Float3 intensity{1, 1, 1};  ///< colour times candela, or times lux of a directional light
  Float3 position{0, 0, 0};
  Float3 direction{0, 0, -1};                     ///< in which it shines, unit length
  float range = 0;                                ///< metres; 0: infinite
  float inner_cone = 0, outer_cone = 0.7853982F;  ///< radians
};

struct Camera {
  std::string name;
  Matrix34 to_world = kIdentity;  ///< it looks along its -z, without scale
  bool perspective = true;
  float yfov = 0.7F;          ///< radians
  float aspect_ratio = 0;     ///< width by height of a perspective camera; 0: the picture's
  float xmag = 1, ymag = 1;   ///< half extents of an orthographic camera
  float znear = 0, zfar = 0;  ///< 0: none
};

/// Radiance from far away by direction: an equirectangular image whose middle column is -z, whose
/// upper row is +y, and which turns to +x on the right.
struct EnvironmentImage {
  std::uint32_t width = 0, height = 0;
  std::vector<Float3> radiance;  ///< rows from the top, finite and not negative
};

struct Scene {
  std::vector<Mesh> meshes;
  std::vector<SceneMaterial> materials;
  std::vector<Texture> textures;
  std::vector<Instance> instances;    ///< visible ones
  std::vector<std::uint32_t> framed;  ///< indices of the framed instances; empty: all
  std::vector<Light> lights;
  std::vector<Camera> cameras;
  std::shared_ptr<const EnvironmentImage> environment;  ///< null: none
  /// Warnings about parts that are rendered differently or not at all, one sentence each.
  std::vector<std::string> notes;
};

}  // namespace gltfx::render
