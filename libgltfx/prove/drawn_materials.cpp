// SPDX-License-Identifier: Apache-2.0
#include "prove/drawn_materials.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "prove/drawn_items.hpp"

namespace gltfx::prove {
namespace {

using model::Material;
using model::RootArray;
using Parameter = MaterialParameter;
using Slot = MaterialSlot;

/// What an effect reads beside its strength.
struct Effect {
  Parameter strength;
  std::initializer_list<Parameter> parameters;
  std::initializer_list<Slot> slots;
};

void reset(Material& material, Parameter parameter) {
  for (const ParameterRow& row : material_table::kRows) {
    if (row.parameter == parameter) {
      material.of(parameter) = row.absent;
      return;
    }
  }
}

bool is_zero(const std::array<float, 4>& values) {
  return std::all_of(values.begin(), values.end(), [](float each) { return each == 0; });
}

void drop_effect(Material& material, const Effect& effect) {
  if (!is_zero(material.of(effect.strength))) return;
  for (const Parameter each : effect.parameters) reset(material, each);
  for (const Slot each : effect.slots) material.of(each) = {};
}

void drop_effects_without_strength(Material& material) {
  const Effect effects[] = {
      {Parameter::emissive, {Parameter::emissive_strength}, {Slot::emissive}},
      {Parameter::clearcoat,
       {Parameter::clearcoat_roughness, Parameter::clearcoat_normal_scale},
       {Slot::clearcoat, Slot::clearcoat_roughness, Slot::clearcoat_normal}},
      {Parameter::sheen_color,
       {Parameter::sheen_roughness},
       {Slot::sheen_color, Slot::sheen_roughness}},
      {Parameter::transmission, {}, {Slot::transmission}},
      {Parameter::thickness,
       {Parameter::attenuation_distance, Parameter::attenuation_color},
       {Slot::thickness}},
      {Parameter::iridescence,
       {Parameter::iridescence_ior, Parameter::iridescence_thickness_minimum,
        Parameter::iridescence_thickness},
       {Slot::iridescence, Slot::iridescence_thickness}},
      {Parameter::anisotropy, {Parameter::anisotropy_rotation}, {Slot::anisotropy}},
  };
  for (const Effect& effect : effects) drop_effect(material, effect);
  const std::pair<Slot, Parameter> normals[] = {
      {Slot::normal, Parameter::normal_scale},
      {Slot::clearcoat_normal, Parameter::clearcoat_normal_scale}};
  for (const auto& [slot, scale] : normals) {
    if (!material.of(slot).texture) reset(material, scale);
  }
}

// Emission is the product of its color and its strength.
void multiply_emission(Material& material) {
  float& strength = material.of(Parameter::emissive_strength)[0];
  for (std::size_t i = 0; i < 3; ++i) material.of(Parameter::emissive)[i] *= strength;
  strength = 1;
}

// Up to rounding.
bool are_near(const decltype(Material::values)& ours, const decltype(Material::values)& theirs) {
  constexpr float kRounding = 1e-6F;
  for (std::size_t i = 0; i < ours.size(); ++i) {
    for (std::size_t k = 0; k < ours[i].size(); ++k) {
      const float a = ours[i][k];
      const float b = theirs[i][k];
      if (a != b && !(std::fabs(a - b) <= kRounding * std::max(std::fabs(a), std::fabs(b)))) {
        return false;
      }
    }
  }
  return true;
}

// An unlit material has no light to reflect.
Material without_light(const Material& material) {
  Material unlit;
  for (const ParameterRow& row : material_table::kRows) unlit.of(row.parameter) = row.absent;
  unlit.alpha_mode = material.alpha_mode;
  unlit.double_sided = material.double_sided;
  unlit.unlit = true;
  for (const Parameter each : {Parameter::base_color, Parameter::alpha_cutoff}) {
    unlit.of(each) = material.of(each);
  }
  unlit.of(Slot::base_color) = material.of(Slot::base_color);
  return unlit;
}

void drop_unread(Material& material) {
  material.name.clear();
  if (material.unlit) material = without_light(material);
  drop_effects_without_strength(material);
  multiply_emission(material);
  if (material.alpha_mode != model::AlphaMode::mask) reset(material, Parameter::alpha_cutoff);
  if (material.alpha_mode == model::AlphaMode::opaque) material.of(Parameter::base_color)[3] = 1;
  for (model::TextureSlot& slot : material.slots) {
    if (!slot.texture) slot = {};
  }
}

bool is_covered_extension(std::string_view name) {
  const bool core = name == "KHR_materials_unlit" || name == "KHR_texture_transform";
  return core || std::any_of(std::begin(material_table::kTexts), std::end(material_table::kTexts),
                             [&](const MaterialText& text) {
                               return text.extension == name && name != "VRMC_materials_mtoon";
                             });
}

}  // namespace

DrawnMaterials::DrawnMaterials(const Comparison& comparison)
    : all_(comparison),
      images_(comparison),
      our_animated_(find_pointed_items(comparison.ours, comparison.ours.list("/materials"))),
      their_animated_(find_pointed_items(comparison.theirs, comparison.theirs.list("/materials"))) {
}

DrawnMaterials::Looks DrawnMaterials::read(const Content& content,
                                           std::optional<std::uint32_t> material) {
  const model::Asset& asset = content.side().asset();
  Looks looks;
  if (material) {
    looks.material = model::read_material(asset, *material);
    const model::Properties own(asset.document(), asset.elements(RootArray::materials)[*material]);
    looks.occlusion = model::read_slot(asset, own, "occlusionTexture");
    looks.occlusion_strength = own.object("occlusionTexture").number("strength", 1);
  } else {
    for (const ParameterRow& row : material_table::kTexts[0].parameters) {
      looks.material.of(row.parameter) = row.absent;
    }
    std::for_each(std::rbegin(material_table::kRows), std::rend(material_table::kRows),
                  [&](const ParameterRow& row) { looks.material.of(row.parameter) = row.absent; });
  }
  drop_unread(looks.material);
  if (!looks.occlusion.texture || looks.occlusion_strength == 0 || looks.material.unlit) {
    looks.occlusion = {};
    looks.occlusion_strength = 1;
  }
  return looks;
}

bool DrawnMaterials::same_texture(std::uint32_t ours, std::uint32_t theirs) {
  const auto read = [](const Content& content, std::uint32_t texture) {
    const model::Asset& asset = content.side().asset();
    return model::read_texture(asset, asset.elements(RootArray::textures)[texture]);
  };
  const model::Texture here = read(all_.ours, ours);
  const model::Texture there = read(all_.theirs, theirs);
  const auto same_image = [&](std::uint32_t a, std::uint32_t b) {
    const ItemId one{all_.ours.list("/images"), a};
    const ItemId other{all_.theirs.list("/images"), b};
    return all_.match.same(one, other) || images_.are_equal(one, other);
  };
  return here.sampler == there.sampler &&
         std::equal(here.images.begin(), here.images.end(), there.images.begin(),
                    there.images.end(), same_image);
}

bool DrawnMaterials::same_slot(const model::TextureSlot& ours, const model::TextureSlot& theirs) {
  model::TextureSlot placed = theirs;
  placed.texture = ours.texture;
  if (!(ours == placed) || ours.texture.has_value() != theirs.texture.has_value()) return false;
  return !ours.texture || same_texture(*ours.texture, *theirs.texture);
}

bool DrawnMaterials::are_alike(std::optional<std::uint32_t> ours,
                               std::optional<std::uint32_t> theirs) {
  if ((ours && our_animated_[*ours]) || (theirs && their_animated_[*theirs])) return false;
  const auto [at, is_new] =
      known_.try_emplace({ours.value_or(kNoItem), theirs.value_or(kNoItem)}, false);
  if (!is_new) return at->second;
  const Looks here = read(all_.ours, ours);
  const Looks there = read(all_.theirs, theirs);
  const Material& a = here.material;
  const Material& b = there.material;
  bool alike =
      a.alpha_mode == b.alpha_mode && a.double_sided == b.double_sided && a.unlit == b.unlit &&
      !a.toon && !b.toon && a.specular_glossiness == b.specular_glossiness &&
      a.first_generation == b.first_generation && a.scattering == b.scattering &&
      are_near(a.values, b.values) && here.occlusion_strength == there.occlusion_strength &&
      same_slot(here.occlusion, there.occlusion);
  for (std::size_t i = 0; alike && i < a.slots.size(); ++i) {
    alike = same_slot(a.slots[i], b.slots[i]);
  }
  at->second = alike;
  return alike;
}

bool DrawnMaterials::covers(const Content& content, const std::string& pointer) const {
  const Side& side = content.side();
  const json::Document& document = side.document();
  json::NodeId value = side.tree().find(pointer).node;
  if (value == json::kNoNode) return false;
  const auto all_covered = [&](json::NodeId extensions) {
    if (!document.is_object(extensions)) return false;
    for (const auto member : document.members(extensions)) {
      const std::string_view name = document.key(member.key_id);
      const bool known =
          document.is_object(member.value) && side.graph().type(member.value) != schema::kNone;
      if (known && !is_covered_extension(name) && !content.storage().contains(name)) return false;
    }
    return true;
  };
  if (side.tree().is_member(value) && side.tree().name(value) == "extensions" &&
      !all_covered(value)) {
    return false;
  }
  // Its own extension and those around it.
  for (; value != json::kNoNode && value != 0; value = side.tree().parent(value)) {
    const json::NodeId above = side.tree().parent(value);
    if (above == json::kNoNode || !side.tree().is_member(value)) continue;
    const bool in_list = side.tree().is_member(above) && side.tree().name(above) == "extensions";
    if (in_list && !is_covered_extension(side.tree().name(value))) return false;
  }
  return true;
}

}  // namespace gltfx::prove
