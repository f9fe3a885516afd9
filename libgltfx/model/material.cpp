// SPDX-License-Identifier: Apache-2.0
#include "model/material.hpp"

#include <algorithm>
#include <cmath>

#include "model/fields.hpp"

namespace gltfx::model {
namespace {

using Parameter = MaterialParameter;

constexpr std::string_view kFirstTranslucency = "KHR_materials_translucency";

AlphaMode alpha_mode(const Properties& material) {
  const std::string mode = string_member(material.document(), material.node(), "alphaMode");
  if (mode == "MASK") return AlphaMode::mask;
  return mode == "BLEND" ? AlphaMode::blend : AlphaMode::opaque;
}

bool has(const Properties& owner, std::string_view name) {
  return owner.document().find(owner.node(), name) != json::kNoNode;
}

// Drafts changed names; the existing member counts.
template <class Row>
std::string_view name_in(const Properties& owner, const Row& row) {
  return row.alias.empty() || has(owner, row.property) ? row.property : row.alias;
}

Properties owner_in(const Properties& object, std::string_view owner) {
  return owner.empty() ? object : object.object(owner);
}

// A parameter without a default is a distance: infinite when absent or 0.
std::array<float, 4> value_of(const Properties& owner, const ParameterRow& row) {
  const std::string_view name = name_in(owner, row);
  std::array<float, 4> value = row.absent;
  const Limits limits{row.least, row.most};
  if (row.numbers > 1) {
    owner.read(name, {value.data(), row.numbers}, limits);
  } else {
    value[0] = owner.number(name, row.absent[0], limits);
    if (std::isinf(row.absent[0]) && value[0] <= 0) value[0] = row.absent[0];
  }
  return value;
}

// Slots of the predecessors of diffuse transmission were also written as bare indices.
TextureSlot slot_of(const Asset& asset, const Properties& owner, const SlotRow& row, bool bare) {
  const std::string_view name = name_in(owner, row);
  TextureSlot slot = read_slot(asset, owner, name);
  if (bare && !slot.texture) slot.texture = asset.index(owner.node(), name, RootArray::textures);
  return slot;
}

void read_text(const Asset& asset, const Properties& object, const MaterialText& text,
               Material& to) {
  for (const ParameterRow& row : text.parameters) {
    to.of(row.parameter) = value_of(owner_in(object, row.owner), row);
  }
  const bool bare = text.extension.ends_with("_translucency");
  for (const SlotRow& row : text.slots) {
    to.of(row.slot) = slot_of(asset, owner_in(object, row.owner), row, bare);
  }
}

Scattering scattering_of(std::string_view extension) {
  if (extension == "KHR_materials_scatter") return Scattering::unified;
  if (extension == "KHR_materials_volume_scatter") return Scattering::multiscatter;
  const bool distance = extension == "KHR_materials_sss" || extension == "KHR_materials_subsurface";
  return distance ? Scattering::distance : Scattering::none;
}

bool scatters(const Material& material, Scattering kind) {
  const auto& color = material.of(Parameter::scatter_color);
  switch (kind) {
    case Scattering::none:
      return true;
    case Scattering::distance:
      return std::isfinite(material.of(Parameter::scatter_distance)[0]);
    case Scattering::multiscatter:
      return std::any_of(color.begin(), color.begin() + 3, [](float c) { return c != 0; });
    case Scattering::unified:
      break;
  }
  return material.of(Parameter::scatter_strength)[0] > 0;
}

// Requirements of the specifications beyond names and ranges.
void finish(Material& material) {
  // An index is 0, which has a special meaning, or at least 1.
  float& ior = material.of(Parameter::ior)[0];
  if (ior > 0 && ior < 1) ior = 1;
  // The phase function of a medium is undefined at the ends of the range.
  float& anisotropy = material.of(Parameter::scatter_anisotropy)[0];
  anisotropy = std::clamp(anisotropy, -0.999F, 0.999F);
  if (!material.specular_glossiness) return;
  material.of(MaterialSlot::specular) = {};
  material.of(MaterialSlot::specular_color) = {};
}

// If several extensions define a parameter, the newest with an effect counts.
void read_extension(const Asset& asset, const Properties& object, const MaterialText& text,
                    Material& material) {
  if (!object.exists()) return;
  Material with = material;
  read_text(asset, object, text, with);
  const Scattering kind = scattering_of(text.extension);
  if (!scatters(with, kind)) return;
  material = std::move(with);
  if (kind != Scattering::none) material.scattering = kind;
  if (text.extension == kFirstTranslucency) {
    material.first_generation =
        !has(object, "translucencyColorFactor") && !has(object, "translucencyColorTexture");
  } else if (text.extension == "KHR_materials_diffuse_transmission") {
    material.first_generation = false;
  }
}

}  // namespace

Material read_material(const Asset& asset, std::uint32_t index, const AnimatedValues* animated) {
  const Properties properties(asset.document(), asset.elements(RootArray::materials)[index],
                              animated, "/materials/" + std::to_string(index));
  Material material;
  material.name = asset.name(properties.node());
  material.alpha_mode = alpha_mode(properties);
  material.double_sided = properties.flag("doubleSided", false);
  const Properties extensions = properties.object("extensions");
  const auto carries = [&](std::string_view name) { return extensions.object(name).exists(); };
  material.toon = carries("VRMC_materials_mtoon");
  material.unlit = !material.toon && carries("KHR_materials_unlit");
  material.specular_glossiness = carries("KHR_materials_pbrSpecularGlossiness");
  std::for_each(std::rbegin(material_table::kRows), std::rend(material_table::kRows),
                [&](const ParameterRow& row) { material.of(row.parameter) = row.absent; });
  for (const MaterialText& text : material_table::kTexts) {
    if (text.extension.empty()) {
      read_text(asset, properties, text, material);
    } else {
      read_extension(asset, extensions.object(text.extension), text, material);
    }
  }
  finish(material);
  return material;
}

}  // namespace gltfx::model
