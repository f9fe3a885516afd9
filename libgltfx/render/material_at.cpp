// SPDX-License-Identifier: Apache-2.0
#include "render/material_at.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "base/packed.hpp"
#include "render/surface.hpp"

namespace gltfx::render {
namespace {

// Multiplies the parameters of a slot. If several share its texels, these are read once.
void scale_by_slot(const SlotReader& reader, Slot slot, Material& m) {
  const auto& scales = reading(slot).scales;
  const Float4 texel = scales.size() > 1 ? reader.texel(slot) : Float4();
  for (const Scaling& scaling : scales) {
    const ParameterMember& member = kParameterMembers[static_cast<std::size_t>(scaling.parameter)];
    if (const auto* color = std::get_if<Rgb Material::*>(&member)) {
      if (max_value(m.**color) > 0) reader.scale(m.**color, slot);
    } else if (const auto* number = std::get_if<double Material::*>(&member)) {
      if (scales.size() > 1) {
        m.** number *= static_cast<double>(texel[scaling.channel]);
      } else {
        reader.scale(m.**number, slot, scaling.channel);
      }
    }
  }
}

void read_anisotropy(const SlotReader& reader, Material& m) {
  if (m.anisotropy == 0 || !reader.has(Slot::anisotropy)) return;
  const Float4 texel = reader.texel(Slot::anisotropy);
  m.anisotropy *= static_cast<double>(texel[2]);
  m.anisotropy_rotation +=
      std::atan2(2.0 * static_cast<double>(texel[1]) - 1, 2.0 * static_cast<double>(texel[0]) - 1);
}

void read_thickness_of_film(const SlotReader& reader, Material& m) {
  if (m.iridescence <= 0 || !reader.has(Slot::iridescence_thickness)) return;
  const auto least = static_cast<double>(reader.material().iridescence_thickness_minimum);
  const auto share = static_cast<double>(reader.texel(Slot::iridescence_thickness)[1]);
  m.iridescence_thickness = least + (m.iridescence_thickness - least) * share;
}

// Other parameters do not change.
void read_specular_glossiness(const SlotReader& reader, Material& m) {
  Rgb specular = to_vec(reader.material().f0);
  auto glossiness = static_cast<double>(reader.material().glossiness);
  if (reader.has(Slot::specular_glossiness)) {
    reader.scale(specular, Slot::specular_glossiness);
    glossiness *= static_cast<double>(reader.texel(Slot::specular_glossiness)[3]);
  }
  const Material converted = gltfx::specular_glossiness(m.base_color, specular, glossiness);
  m.metallic = converted.metallic;
  m.roughness = converted.roughness;
  m.ior = converted.ior;
  m.specular = converted.specular;
  m.specular_color = converted.specular_color;
}

// The steps between the two tones are those of a toon shader; here light falls off as on any matte
// surface, of a color between them.
void read_toon(const SlotReader& reader, Material& m) {
  Rgb shade = to_vec(reader.material().shade_color);
  if (reader.has(Slot::shade_color)) reader.scale(shade, Slot::shade_color);
  m.base_color = (m.base_color + shade) * 0.5;
  m.metallic = 0;
  m.roughness = 1;
  m.specular = 0;
}

}  // namespace

Float4 SlotReader::texel(Slot slot) const {
  const TextureUse& use = material_.use(slot);
  const Texture& texture = scene_.textures[use.texture];
  const Float2 uv = uv_of(use);
  const bool srgb = reading(slot).srgb;
  return texture.missing ? sample_texture(texture, uv[0], uv[1], srgb)
                         : sample_texture(texture, patch_of(texture, uv), srgb);
}

void SlotReader::scale(Rgb& value, Slot slot) const {
  if (!has(slot)) return;
  const Float4 t = texel(slot);
  value *= Rgb(static_cast<double>(t[0]), static_cast<double>(t[1]), static_cast<double>(t[2]));
}

void SlotReader::scale(double& value, Slot slot, std::uint32_t channel) const {
  if (!has(slot) || value == 0) return;
  const TextureUse& use = material_.use(slot);
  const Texture& texture = scene_.textures[use.texture];
  if (texture.missing) return;
  value *= static_cast<double>(sample_channel(texture, patch_of(texture, uv_of(use)),
                                              use.channel == kNone ? channel : use.channel));
}

Float2 SlotReader::uv_of(const TextureUse& use) const {
  if (use.uv_set != set_) {
    set_ = use.uv_set;
    uv_ = set_ < uvs_.size() ? uvs_[set_] : uv_at(mesh_, set_, hit_);
  }
  return transform_uv(use, uv_);
}

const TexelPatch& SlotReader::patch_of(const Texture& texture, const Float2& uv) const {
  const auto shape = [](const Texture& t) {
    return std::tie(t.width, t.height, t.wrap_s, t.wrap_t, t.filter);
  };
  if (patched_ == nullptr || uv != patch_uv_ || shape(texture) != shape(*patched_)) {
    patch_ = patch_at(texture, uv);
    patched_ = &texture;
    patch_uv_ = uv;
  }
  return patch_;
}

Material material_at(const SlotReader& reader) {
  const SceneMaterial& material = reader.material();
  const Mesh& mesh = reader.mesh();
  Material m = material.factors;
  const Float4 tint = color_at(mesh, reader.hit());
  m.base_color *= to_vec({tint[0], tint[1], tint[2]});
  // The thickness of a volume comes from the paths through it, not from its texture.
  for (const TextureUse& use : material.textures) {
    if (use.slot == Slot::thickness || use.texture == kNone) continue;
    if (!m.unlit || use.slot == Slot::base_color) scale_by_slot(reader, use.slot, m);
  }
  if (mesh.unlit && !m.unlit) {
    m.base_color += m.emissive;
    m.unlit = true;
  }
  if (m.unlit) return m;
  if (material.toon) read_toon(reader, m);
  if (material.specular_glossiness) read_specular_glossiness(reader, m);
  read_anisotropy(reader, m);
  read_thickness_of_film(reader, m);
  if (material.tinted_by_base_color) add_translucency(m, m.diffuse_transmission);
  return m;
}

std::optional<Vec3d> mapped_normal(const SlotReader& reader, Slot slot) {
  const SceneMaterial& material = reader.material();
  if (!reader.has(slot) || reader.is_missing(slot)) return std::nullopt;
  const Float4 texel = reader.texel(slot);
  const auto scale = static_cast<double>(slot == Slot::normal ? material.normal_scale
                                                              : material.clearcoat_normal_scale);
  const Vec3d n((2.0 * static_cast<double>(texel[0]) - 1) * scale,
                (2.0 * static_cast<double>(texel[1]) - 1) * scale,
                2.0 * static_cast<double>(texel[2]) - 1);
  const double norm = length(n);
  if (!(norm > 1e-6)) return std::nullopt;
  return n / norm;
}

}  // namespace gltfx::render
