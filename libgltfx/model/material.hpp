// SPDX-License-Identifier: Apache-2.0
/// Materials as numbers: every parameter of the specification's section 3.9 and of the extensions
/// that the shader knows, with their defaults. Colours are linear. A layer or effect that a
/// material does not have is there with the values that make it invisible.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>

#include "model/properties.hpp"
#include "model/texture.hpp"

namespace gltfx::model {

using Color = std::array<float, 3>;

enum class AlphaMode : std::uint8_t { opaque, mask, blend };

/// KHR_materials_pbrSpecularGlossiness; takes the place of metallic-roughness.
struct SpecularGlossiness {
  std::array<float, 4> diffuse_factor{1, 1, 1, 1};
  TextureSlot diffuse_texture;  ///< sRGB, alpha linear
  Color specular_factor{1, 1, 1};
  float glossiness_factor = 1;
  TextureSlot specular_glossiness_texture;  ///< RGB in sRGB, glossiness in A
};

/// KHR_materials_diffuse_transmission, or its forerunner translucency.
struct DiffuseTransmission {
  float factor = 0;
  TextureSlot texture;  ///< A
  /// The first generation of the forerunner: the factor stands in R, and the colour is the base
  /// colour.
  bool first_generation = false;
  Color color_factor{1, 1, 1};
  TextureSlot color_texture;  ///< sRGB
};

/// KHR_materials_volume.
struct Volume {
  float thickness_factor = 0;     ///< 0: a thin wall. In the units of the mesh
  TextureSlot thickness_texture;  ///< G
  float attenuation_distance = std::numeric_limits<float>::infinity();  ///< metres
  Color attenuation_color{1, 1, 1};
};

/// KHR_materials_sss, and KHR_materials_subsurface which has the same two numbers.
struct Subsurface {
  float scatter_distance = std::numeric_limits<float>::infinity();  ///< metres
  Color scatter_color{0, 0, 0};
};

/// KHR_materials_volume_scatter.
struct VolumeScatter {
  Color multiscatter_color{0, 0, 0};
  TextureSlot multiscatter_color_texture;  ///< sRGB
  float anisotropy = 0;                    ///< between -1 and 1
};

/// KHR_materials_scatter.
struct Scatter {
  float strength_factor = 0;
  TextureSlot strength_texture;  ///< A
  Color multiscatter_color_factor{1, 1, 1};
  TextureSlot multiscatter_color_texture;  ///< sRGB
  float anisotropy = 0;                    ///< between -1 and 1
};

struct Specular {
  float factor = 1;
  TextureSlot texture;  ///< A
  Color color_factor{1, 1, 1};
  TextureSlot color_texture;  ///< sRGB
};

struct Sheen {
  Color color_factor{0, 0, 0};
  TextureSlot color_texture;  ///< sRGB
  float roughness_factor = 0;
  TextureSlot roughness_texture;  ///< A
};

struct Clearcoat {
  float factor = 0;
  TextureSlot texture;  ///< R
  float roughness_factor = 0;
  TextureSlot roughness_texture;  ///< G
  TextureSlot normal_texture;
  float normal_scale = 1;
};

struct Anisotropy {
  float strength = 0;
  float rotation = 0;   ///< radians, counter-clockwise from the tangent
  TextureSlot texture;  ///< direction in RG, strength in B
};

struct Iridescence {
  float factor = 0;
  TextureSlot texture;  ///< R
  float ior = 1.3F;
  float thickness_minimum = 100;  ///< nanometres
  float thickness_maximum = 400;  ///< nanometres
  TextureSlot thickness_texture;  ///< G
};

struct Material {
  std::string name;
  std::array<float, 4> base_color_factor{1, 1, 1, 1};
  TextureSlot base_color_texture;  ///< sRGB, alpha linear
  float metallic_factor = 1;
  float roughness_factor = 1;
  TextureSlot metallic_roughness_texture;  ///< roughness in G, metalness in B
  TextureSlot normal_texture;
  float normal_scale = 1;
  TextureSlot occlusion_texture;  ///< R
  float occlusion_strength = 1;
  Color emissive_factor{0, 0, 0};
  float emissive_strength = 1;
  TextureSlot emissive_texture;  ///< sRGB
  AlphaMode alpha_mode = AlphaMode::opaque;
  float alpha_cutoff = 0.5F;
  bool double_sided = false;
  bool unlit = false;
  float ior = 1.5F;  ///< 0: the specification's way to write an infinite one
  float dispersion = 0;
  float transmission_factor = 0;
  TextureSlot transmission_texture;  ///< R
  std::optional<SpecularGlossiness> specular_glossiness;
  DiffuseTransmission diffuse_transmission;
  Volume volume;
  Subsurface subsurface;
  VolumeScatter volume_scatter;
  Scatter scatter;
  Specular specular;
  Sheen sheen;
  Clearcoat clearcoat;
  Anisotropy anisotropy;
  Iridescence iridescence;
};

/// The material at `index`. Numbers out of their range are brought into it.
Material read_material(const Asset& asset, std::uint32_t index,
                       const AnimatedValues* animated = nullptr);

/// Calls `use` with every slot that has a texture.
template <typename Use>
void for_each_slot(const Material& material, Use use) {
  const auto visit = [&](const TextureSlot& slot) {
    if (slot.texture) use(slot);
  };
  for (const TextureSlot* slot : {&material.base_color_texture,
                                  &material.metallic_roughness_texture,
                                  &material.normal_texture,
                                  &material.occlusion_texture,
                                  &material.emissive_texture,
                                  &material.transmission_texture,
                                  &material.diffuse_transmission.texture,
                                  &material.diffuse_transmission.color_texture,
                                  &material.volume.thickness_texture,
                                  &material.volume_scatter.multiscatter_color_texture,
                                  &material.scatter.strength_texture,
                                  &material.scatter.multiscatter_color_texture,
                                  &material.specular.texture,
                                  &material.specular.color_texture,
                                  &material.sheen.color_texture,
                                  &material.sheen.roughness_texture,
                                  &material.clearcoat.texture,
                                  &material.clearcoat.roughness_texture,
                                  &material.clearcoat.normal_texture,
                                  &material.anisotropy.texture,
                                  &material.iridescence.texture,
                                  &material.iridescence.thickness_texture}) {
    visit(*slot);
  }
  if (!material.specular_glossiness) return;
  visit(material.specular_glossiness->diffuse_texture);
  visit(material.specular_glossiness->specular_glossiness_texture);
}

}  // namespace gltfx::model
