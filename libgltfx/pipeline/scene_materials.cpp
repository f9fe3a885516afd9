// SPDX-License-Identifier: Apache-2.0
#include "pipeline/scene_materials.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace gltfx {
namespace {

using bake::Slot;

Rgb rgb(const std::array<float, 3>& from) {
  return {static_cast<double>(from[0]), static_cast<double>(from[1]), static_cast<double>(from[2])};
}

// The text of KHR_texture_transform contradicts itself: its words and its example turn coordinates
// counter-clockwise as they are seen, with v running down the image; its lines of GLSL turn them
// the other way. Words and example it is, as in other renderers.
std::array<bake::Float3, 2> matrix_of(const model::TextureSlot& slot) {
  const float sine = std::sin(slot.rotation);
  const float cosine = std::cos(slot.rotation);
  const auto& [x, y] = slot.scale;
  return {{{cosine * x, sine * y, slot.offset[0]}, {-sine * x, cosine * y, slot.offset[1]}}};
}

/// One material on its way.
class Translation {
 public:
  Translation(const model::Material& from, SceneTextures& textures)
      : from_(from), textures_(textures) {}

  std::pair<bake::SceneMaterial, MaterialNeeds> run() {
    find_sets();
    set_surface();
    set_media();
    set_layers();
    set_textures();
    if (from_.specular_glossiness) set_specular_glossiness(*from_.specular_glossiness);
    choose_tangents();
    return {std::move(to_), std::move(needs_)};
  }

 private:
  // Occlusion is not read: light finds its way by itself.
  void find_sets() {
    auto& sets = needs_.tex_coords;
    for_each_slot(from_, [&](const model::TextureSlot& slot) {
      if (&slot != &from_.occlusion_texture) sets.push_back(slot.tex_coord);
    });
    // Tangents without a texture to go by are those of the first set.
    if (from_.anisotropy.strength > 0) sets.push_back(0);
    std::sort(sets.begin(), sets.end());
    sets.erase(std::unique(sets.begin(), sets.end()), sets.end());
  }

  std::uint32_t position_of(std::uint32_t set) const {
    const auto& sets = needs_.tex_coords;
    return static_cast<std::uint32_t>(std::lower_bound(sets.begin(), sets.end(), set) -
                                      sets.begin());
  }

  void use(Slot slot, const model::TextureSlot& from) {
    if (!from.texture) return;
    bake::TextureUse& to = to_.use(slot);
    to.texture = textures_.use(*from.texture);
    to.uv_set = position_of(from.tex_coord);
    to.transform = matrix_of(from);
  }

  void set_surface() {
    Material& m = to_.factors;
    to_.name = from_.name;
    const auto& base = from_.base_color_factor;
    m.base_color = rgb({base[0], base[1], base[2]});
    to_.alpha = base[3];
    m.metallic = static_cast<double>(from_.metallic_factor);
    m.roughness = static_cast<double>(from_.roughness_factor);
    m.emissive = rgb(from_.emissive_factor) * static_cast<double>(from_.emissive_strength);
    to_.alpha_mode = static_cast<bake::AlphaMode>(from_.alpha_mode);
    to_.alpha_cutoff = from_.alpha_cutoff;
    to_.double_sided = from_.double_sided;
    to_.normal_scale = from_.normal_scale;
    m.unlit = from_.unlit;
    m.ior = static_cast<double>(from_.ior);
    m.specular = static_cast<double>(from_.specular.factor);
    m.specular_color = rgb(from_.specular.color_factor);
  }

  void set_media() {
    Material& m = to_.factors;
    m.transmission = static_cast<double>(from_.transmission_factor);
    m.dispersion = static_cast<double>(from_.dispersion);
    const model::DiffuseTransmission& diffuse = from_.diffuse_transmission;
    m.diffuse_transmission = static_cast<double>(diffuse.factor);
    m.diffuse_transmission_color = rgb(diffuse.color_factor);
    to_.tinted_by_base_color = diffuse.first_generation;
    m.thickness = static_cast<double>(from_.volume.thickness_factor);
    m.attenuation_distance = static_cast<double>(from_.volume.attenuation_distance);
    m.attenuation_color = rgb(from_.volume.attenuation_color);
    set_scattering();
  }

  // Of several texts about scattering the latest counts.
  void set_scattering() {
    Material& m = to_.factors;
    const Rgb multiscatter = rgb(from_.volume_scatter.multiscatter_color);
    if (from_.scatter.strength_factor > 0) {
      m.scattering = Scattering::unified;
      m.scatter_strength = static_cast<double>(from_.scatter.strength_factor);
      m.scatter_color = rgb(from_.scatter.multiscatter_color_factor);
      m.scatter_anisotropy = static_cast<double>(from_.scatter.anisotropy);
      use(Slot::scatter_strength, from_.scatter.strength_texture);
      use(Slot::multiscatter_color, from_.scatter.multiscatter_color_texture);
    } else if (multiscatter != Rgb()) {
      m.scattering = Scattering::multiscatter;
      m.scatter_color = multiscatter;
      m.scatter_anisotropy = static_cast<double>(from_.volume_scatter.anisotropy);
      use(Slot::multiscatter_color, from_.volume_scatter.multiscatter_color_texture);
    } else if (std::isfinite(from_.subsurface.scatter_distance)) {
      m.scattering = Scattering::distance;
      m.scatter_distance = static_cast<double>(from_.subsurface.scatter_distance);
      m.scatter_color = rgb(from_.subsurface.scatter_color);
    }
  }

  void set_layers() {
    Material& m = to_.factors;
    m.sheen_color = rgb(from_.sheen.color_factor);
    m.sheen_roughness = static_cast<double>(from_.sheen.roughness_factor);
    m.clearcoat = static_cast<double>(from_.clearcoat.factor);
    m.clearcoat_roughness = static_cast<double>(from_.clearcoat.roughness_factor);
    to_.clearcoat_normal_scale = from_.clearcoat.normal_scale;
    m.anisotropy = static_cast<double>(from_.anisotropy.strength);
    m.anisotropy_rotation = static_cast<double>(from_.anisotropy.rotation);
    m.iridescence = static_cast<double>(from_.iridescence.factor);
    m.iridescence_ior = static_cast<double>(from_.iridescence.ior);
    m.iridescence_thickness = static_cast<double>(from_.iridescence.thickness_maximum);
    to_.iridescence_thickness_minimum = from_.iridescence.thickness_minimum;
  }

  void set_textures() {
    use(Slot::base_color, from_.base_color_texture);
    use(Slot::metallic_roughness, from_.metallic_roughness_texture);
    use(Slot::normal, from_.normal_texture);
    use(Slot::emissive, from_.emissive_texture);
    use(Slot::transmission, from_.transmission_texture);
    use(Slot::diffuse_transmission, from_.diffuse_transmission.texture);
    if (to_.tinted_by_base_color) to_.use(Slot::diffuse_transmission).channel = 0;
    use(Slot::diffuse_transmission_color, from_.diffuse_transmission.color_texture);
    use(Slot::thickness, from_.volume.thickness_texture);
    use(Slot::specular, from_.specular.texture);
    use(Slot::specular_color, from_.specular.color_texture);
    use(Slot::sheen_color, from_.sheen.color_texture);
    use(Slot::sheen_roughness, from_.sheen.roughness_texture);
    use(Slot::clearcoat, from_.clearcoat.texture);
    use(Slot::clearcoat_roughness, from_.clearcoat.roughness_texture);
    use(Slot::clearcoat_normal, from_.clearcoat.normal_texture);
    use(Slot::anisotropy, from_.anisotropy.texture);
    use(Slot::iridescence, from_.iridescence.texture);
    use(Slot::iridescence_thickness, from_.iridescence.thickness_texture);
  }

  void set_specular_glossiness(const model::SpecularGlossiness& from) {
    const auto& diffuse = from.diffuse_factor;
    to_.specular_glossiness = true;
    to_.factors.base_color = rgb({diffuse[0], diffuse[1], diffuse[2]});
    to_.alpha = diffuse[3];
    to_.specular = from.specular_factor;
    to_.glossiness = from.glossiness_factor;
    for (const Slot slot : {Slot::base_color, Slot::specular, Slot::specular_color}) {
      to_.use(slot) = {};
    }
    use(Slot::base_color, from.diffuse_texture);
    use(Slot::specular_glossiness, from.specular_glossiness_texture);
  }

  void choose_tangents() {
    for (const Slot slot : {Slot::normal, Slot::clearcoat_normal, Slot::anisotropy}) {
      if (to_.use(slot).texture == bake::kNone || needs_.tangents) continue;
      needs_.tangents = to_.use(slot);
    }
    if (!needs_.tangents && to_.factors.anisotropy > 0) needs_.tangents = bake::TextureUse();
  }

  const model::Material& from_;
  SceneTextures& textures_;
  bake::SceneMaterial to_;
  MaterialNeeds needs_;
};

}  // namespace

const MaterialNeeds& SceneMaterials::use(const std::optional<std::uint32_t>& material) {
  if (!material) return default_;
  const auto known = known_.find(*material);
  if (known != known_.end()) return known->second;
  MaterialNeeds needs = translate(model::read_material(asset_, *material, &animated_));
  return known_.emplace(*material, std::move(needs)).first->second;
}

MaterialNeeds SceneMaterials::translate(const model::Material& material) {
  auto [translated, needs] = Translation(material, textures_).run();
  needs.material = static_cast<std::uint32_t>(scene_.materials.size());
  scene_.materials.push_back(std::move(translated));
  return std::move(needs);
}

}  // namespace gltfx
