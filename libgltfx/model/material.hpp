// SPDX-License-Identifier: Apache-2.0
/// Materials as numbers: every parameter of the specification's section 3.9 and of the extensions
/// that the shader supports, by the names in schema/, with their defaults. Colours are linear. A
/// missing layer or effect has the values that make it invisible.
#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "base/material_table.hpp"
#include "model/properties.hpp"
#include "model/texture.hpp"

namespace gltfx::model {

enum class AlphaMode : std::uint8_t { opaque, mask, blend };

/// The extension that defines how light scatters in the volume, as gltfx::Scattering.
enum class Scattering : std::uint8_t { none, distance, multiscatter, unified };

struct Material {
  std::string name;
  AlphaMode alpha_mode = AlphaMode::opaque;
  bool double_sided = false;
  bool unlit = false;
  /// VRMC_materials_mtoon, for which unlit and metallic-roughness are the fallback.
  bool toon = false;
  /// KHR_materials_pbrSpecularGlossiness replaces metallic-roughness.
  bool specular_glossiness = false;
  /// The first generation of KHR_materials_translucency: the factor of diffuse transmission is in R
  /// of its texture, and the colour is the base colour.
  bool first_generation = false;
  Scattering scattering = Scattering::none;
  std::array<std::array<float, 4>, kMaterialParameters> values{};  ///< by parameter
  std::array<TextureSlot, kMaterialSlots> slots{};                 ///< by slot

  /// The numbers of a parameter: as many as it has, from the first one.
  std::array<float, 4>& of(MaterialParameter parameter) {
    return values[static_cast<std::size_t>(parameter)];
  }
  const std::array<float, 4>& of(MaterialParameter parameter) const {
    return values[static_cast<std::size_t>(parameter)];
  }
  TextureSlot& of(MaterialSlot slot) { return slots[static_cast<std::size_t>(slot)]; }
  const TextureSlot& of(MaterialSlot slot) const { return slots[static_cast<std::size_t>(slot)]; }
};

/// The material at `index`. Numbers out of their range are clamped.
Material read_material(const Asset& asset, std::uint32_t index,
                       const AnimatedValues* animated = nullptr);

}  // namespace gltfx::model
