// SPDX-License-Identifier: Apache-2.0
#include "pipeline/scene_materials.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace gltfx {
namespace {

using bake::Slot;

// Puts the numbers of a parameter where they belong.
struct Assign {
  bake::SceneMaterial& to;
  const std::array<float, 4>& from;

  void operator()(double Material::*member) const {
    to.factors.*member = static_cast<double>(from[0]);
  }
  void operator()(Rgb Material::*member) const {
    to.factors.*member = {static_cast<double>(from[0]), static_cast<double>(from[1]),
                          static_cast<double>(from[2])};
  }
  void operator()(float bake::SceneMaterial::*member) const { to.*member = from[0]; }
  void operator()(bake::Float3 bake::SceneMaterial::*member) const {
    to.*member = {from[0], from[1], from[2]};
  }
};

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
    set_parameters();
    for (std::size_t i = 0; i < kMaterialSlots; ++i) use(static_cast<Slot>(i), from_.slots[i]);
    if (to_.tinted_by_base_color) to_.use(Slot::diffuse_transmission).channel = 0;
    choose_tangents();
    return {std::move(to_), std::move(needs_)};
  }

 private:
  void find_sets() {
    auto& sets = needs_.tex_coords;
    for (const model::TextureSlot& slot : from_.slots) {
      if (slot.texture) sets.push_back(slot.tex_coord);
    }
    // Tangents without a texture to go by are those of the first set.
    if (from_.of(MaterialParameter::anisotropy)[0] > 0) sets.push_back(0);
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

  void set_parameters() {
    for (std::size_t i = 0; i < kMaterialParameters; ++i) {
      std::visit(Assign{to_, from_.values[i]}, bake::kParameterMembers[i]);
    }
    Material& m = to_.factors;
    m.emissive *= static_cast<double>(to_.emissive_strength);
    m.unlit = from_.unlit;
    m.scattering = static_cast<Scattering>(from_.scattering);
    to_.name = from_.name;
    to_.alpha = from_.of(MaterialParameter::base_color)[3];
    to_.alpha_mode = static_cast<bake::AlphaMode>(from_.alpha_mode);
    to_.double_sided = from_.double_sided;
    to_.specular_glossiness = from_.specular_glossiness;
    to_.tinted_by_base_color = from_.first_generation;
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
