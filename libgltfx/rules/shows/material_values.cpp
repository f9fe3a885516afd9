// SPDX-License-Identifier: Apache-2.0
// What the text of materials says about how a surface looks.
#include <algorithm>
#include <array>
#include <cctype>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "base/codes.hpp"
#include "model/material.hpp"
#include "rules/finding.hpp"
#include "rules/payload/texture_phase.hpp"
#include "rules/shows/shows.hpp"

namespace gltfx::validate {
namespace {

using json::NodeId;
using model::Material;
using model::RootArray;

// The slots of each material.
class SlotsOfMaterials {
 public:
  explicit SlotsOfMaterials(const DataPhase& phase)
      : slots_(phase.context.asset.count(RootArray::materials)) {
    if (!phase.textures) return;
    for (const TextureSlot& slot : phase.textures->slots) {
      if (slot.material != json::kNoNode) slots_[slot.material_index].push_back(&slot);
    }
  }
  // The slot of that name which has an effect, or null.
  const TextureSlot* find(std::uint32_t material, std::string_view property) const {
    for (const TextureSlot* slot : slots_[material]) {
      if (slot->property == property && !slot->effective.empty()) return slot;
    }
    return nullptr;
  }
  // The base color by metallic-roughness.
  const TextureSlot* base_color(std::uint32_t material) const {
    return find(material, "baseColorTexture");
  }

 private:
  std::vector<std::vector<const TextureSlot*>> slots_;
};

bool is_animated(const DataPhase& phase, const std::string& pointer) {
  return phase.textures && phase.textures->animated.contains(pointer);
}

// --- Emission ---

constexpr float kWhite = 0.95F;

// Whether an image is white in every texel, as far as its pixels are known.
bool is_white(const codec::Image& image) {
  const std::size_t colors = image.channels < 3 ? 1 : 3;
  return std::all_of(image.statistics.begin(),
                     image.statistics.begin() + static_cast<std::ptrdiff_t>(colors),
                     [&](const auto& each) { return each.least * 255 >= image.full() * 250; });
}

void check_emission(DataPhase& phase, std::uint32_t index, const Material& material,
                    const SlotsOfMaterials& slots) {
  const TextureSlot* color = slots.base_color(index);
  if (color == nullptr || material.unlit || material.toon) return;
  const auto& factor = material.of(MaterialParameter::emissive);
  const float strength = material.of(MaterialParameter::emissive_strength)[0];
  if (*std::min_element(factor.begin(), factor.begin() + 3) * strength < kWhite) return;
  const std::string pointer = fmt::format("/materials/{}/emissiveFactor", index);
  if (is_animated(phase, pointer)) return;
  const NodeId object = phase.context.asset.elements(RootArray::materials)[index];
  const std::string label = object_label(phase.context, RootArray::materials, index);
  const std::string base = image_label(phase.context, color->images.front());
  if (material.of(MaterialSlot::emissive).texture) {
    const TextureSlot* emissive = slots.find(index, "emissiveTexture");
    const codec::Image* image =
        emissive == nullptr ? nullptr : phase.textures->pixels.of(emissive->images.front());
    if (image == nullptr || !is_white(*image)) return;
    if (emissive->images.front() == color->images.front()) return;
    report_slot(phase.context, phase.sink, *emissive, Code::EMISSION_HIDES_COLOR,
                fmt::format("{} is white in every texel, so {} is white in any light and {} "
                            "cannot be seen.",
                            image_label(phase.context, emissive->images.front()), label, base));
    return;
  }
  report_at(phase.sink, pointer,
            finding_on(phase.context, phase.context.document.find(object, "emissiveFactor"),
                       Code::EMISSION_HIDES_COLOR,
                       fmt::format("emissiveFactor is white and there is no emissiveTexture, so {} "
                                   "is white in any light and {} cannot be seen.",
                                   label, base)));
}

// --- Metals ---

constexpr std::array<std::string_view, 44> kDielectrics{
    "bark",   "brick",   "bricks",  "cardboard", "carpet",  "ceramic", "cloth", "concrete",
    "cotton", "denim",   "dirt",    "eye",       "eyes",    "fabric",  "face",  "fur",
    "glass",  "grass",   "hair",    "leaf",      "leather", "leaves",  "linen", "paper",
    "pants",  "plaster", "plastic", "porcelain", "rubber",  "sand",    "shirt", "skin",
    "snow",   "soil",    "stone",   "teeth",     "tiles",   "tree",    "wall",  "wood",
    "wooden", "wool",    "foliage", "marble"};
// Words of materials that may be metals all the same.
constexpr std::array<std::string_view, 18> kMetals{
    "metal", "metallic", "steel", "iron",  "chrome", "gold",     "golden",    "silver",   "copper",
    "brass", "bronze",   "tin",   "alloy", "foil",   "aluminum", "aluminium", "titanium", "car"};

// The words of a name: "OakWood_02" has oak and wood.
std::vector<std::string> words_of(std::string_view name) {
  std::vector<std::string> words;
  bool in_word = false;
  bool was_lower = false;
  for (const char each : name) {
    const auto byte = static_cast<unsigned char>(each);
    const bool letter = byte < 128 && std::isalpha(byte) != 0;
    const bool upper = letter && std::isupper(byte) != 0;
    if (letter && (!in_word || (upper && was_lower))) words.emplace_back();
    if (letter) words.back() += static_cast<char>(std::tolower(byte));
    in_word = letter;
    was_lower = letter && !upper;
  }
  return words;
}

template <std::size_t N>
bool is_one_of(const std::array<std::string_view, N>& list, const std::string& word) {
  return std::find(list.begin(), list.end(), word) != list.end();
}

// The word that says that a material is no metal, or empty.
std::string dielectric_word(const std::string& names) {
  std::string found;
  for (std::string& word : words_of(names)) {
    if (is_one_of(kMetals, word)) return {};
    if (found.empty() && is_one_of(kDielectrics, word)) found = std::move(word);
  }
  return found;
}

void check_metal(DataPhase& phase, std::uint32_t index, const Material& material,
                 const SlotsOfMaterials& slots) {
  if (material.unlit || material.toon || material.specular_glossiness) return;
  if (material.of(MaterialSlot::metallic_roughness).texture) return;
  constexpr float kMetal = 0.99F;
  if (material.of(MaterialParameter::metallic)[0] < kMetal) return;
  const TextureSlot* color = slots.base_color(index);
  std::string names = material.name;
  if (color != nullptr) names += " " + image_label(phase.context, color->images.front());
  const std::string word = dielectric_word(names);
  if (word.empty()) return;
  const NodeId object = phase.context.asset.elements(RootArray::materials)[index];
  // Extensions may make it a surface of another kind.
  if (phase.context.document.find(object, "extensions") != json::kNoNode) return;
  const NodeId rough = phase.context.document.find(object, "pbrMetallicRoughness");
  if (rough != json::kNoNode && !phase.context.document.is_object(rough)) return;
  const NodeId written =
      rough == json::kNoNode ? json::kNoNode : phase.context.document.find(rough, "metallicFactor");
  const std::string pointer =
      fmt::format("/materials/{}/pbrMetallicRoughness/metallicFactor", index);
  if (is_animated(phase, pointer)) return;
  report_at(
      phase.sink, pointer,
      finding_on(phase.context, written != json::kNoNode ? written : object, Code::METAL_BY_DEFAULT,
                 fmt::format("metallicFactor is {} and no texture lowers it, so {} is a "
                             "metal, although a name has '{}'.",
                             written == json::kNoNode ? "not set (default: 1)" : "1",
                             object_label(phase.context, RootArray::materials, index), word)));
}

// Avatars of VRM 0.x have their materials outside of `materials`.
bool has_other_materials(const Context& context) {
  const auto& used = context.checked.extensions_used;
  return std::any_of(used.begin(), used.end(),
                     [](const auto& name) { return std::string_view(name) == "VRM"; });
}

// --- Characters ---

// Whether only texels can make a material transparent, and they may.
bool blends_by_texture(DataPhase& phase, std::uint32_t index, const Material& material,
                       const SlotsOfMaterials& slots) {
  if (material.alpha_mode != model::AlphaMode::blend || material.toon) return false;
  if (material.of(MaterialParameter::base_color)[3] < 1) return false;
  if (is_animated(phase, fmt::format("/materials/{}/pbrMetallicRoughness/baseColorFactor", index)))
    return false;
  const TextureSlot* color = slots.base_color(index);
  if (color == nullptr) return false;
  const auto& header = phase.resources.images[color->images.front()].header;
  return header && image::can_be_transparent(*header);
}

void check_bodies(DataPhase& phase, const std::vector<Material>& materials,
                  const SlotsOfMaterials& slots) {
  std::set<std::uint32_t> blended;
  std::vector<std::uint8_t> seen(phase.context.views.meshes.size(), 0);
  std::uint64_t meshes = 0;
  for (const model::Node& node : phase.context.views.nodes) {
    if (!node.skin || !node.mesh || seen[*node.mesh] != 0) continue;
    seen[*node.mesh] = 1;
    ++meshes;
    for (const model::Primitive& primitive : phase.context.views.meshes[*node.mesh].primitives) {
      if (!primitive.material) return;
      const std::uint32_t index = *primitive.material;
      if (blended.count(index) != 0) continue;
      if (!blends_by_texture(phase, index, materials[index], slots)) return;
      blended.insert(index);
    }
  }
  if (blended.empty()) return;
  const std::uint32_t first = *blended.begin();
  const NodeId object = phase.context.asset.elements(RootArray::materials)[first];
  report_at(
      phase.sink, fmt::format("/materials/{}/alphaMode", first),
      finding_on(
          phase.context, phase.context.document.find(object, "alphaMode"), Code::BODY_BLENDED,
          fmt::format("alphaMode is BLEND in {}, so parts may show through others.",
                      blended.size() == 1
                          ? fmt::format("{}, the only one of {}",
                                        object_label(phase.context, RootArray::materials, first),
                                        meshes == 1 ? "the skinned mesh"
                                                    : fmt::format("{} skinned meshes", meshes))
                          : fmt::format("all {} materials of {}", blended.size(),
                                        meshes == 1 ? "the skinned mesh"
                                                    : fmt::format("{} skinned meshes", meshes)))));
}

}  // namespace

void check_material_values(DataPhase& phase) {
  const std::size_t count = phase.context.asset.count(RootArray::materials);
  if (count == 0) return;
  const SlotsOfMaterials slots(phase);
  const bool others = has_other_materials(phase.context);
  std::vector<Material> materials;
  for (std::uint32_t i = 0; i < count; ++i) {
    materials.push_back(model::read_material(phase.context.asset, i));
    check_emission(phase, i, materials[i], slots);
    if (!others) check_metal(phase, i, materials[i], slots);
  }
  check_bodies(phase, materials, slots);
}

}  // namespace gltfx::validate
