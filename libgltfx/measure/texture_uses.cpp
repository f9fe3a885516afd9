// SPDX-License-Identifier: Apache-2.0
#include "measure/texture_uses.hpp"

#include <algorithm>

#include "model/properties.hpp"

namespace gltfx::measure {

using model::RootArray;

const model::TextureSlot* MaterialTextures::find(std::string_view slot) const {
  if (slot.empty()) return base_color.texture ? &base_color : nullptr;
  const auto at = std::find_if(uses.begin(), uses.end(),
                               [&](const TextureUse& use) { return use.slot == slot; });
  return at != uses.end() ? &at->read : nullptr;
}

std::uint32_t MaterialTextures::uv_set() const {
  if (base_color.texture) return base_color.tex_coord;
  const auto least = std::min_element(uses.begin(), uses.end(), [](const auto& a, const auto& b) {
    return a.read.tex_coord < b.read.tex_coord;
  });
  return least != uses.end() ? least->read.tex_coord : 0;
}

std::vector<MaterialTextures> material_textures(const Source& source) {
  const model::Asset& asset = source.asset();
  const auto& objects = asset.elements(RootArray::materials);
  std::vector<MaterialTextures> materials(objects.size());
  for (std::uint32_t i = 0; i < materials.size(); ++i) {
    if (objects[i] == json::kNoNode) continue;
    const model::Material material = model::read_material(asset, i);
    materials[i].base_color = material.of(MaterialSlot::base_color);
    materials[i].base_color_factor = material.of(MaterialParameter::base_color);
  }
  const graph::Tree& tree = source.graph().tree();
  for (const schema::SlotUse& use : source.graph().checked().slots) {
    const json::NodeId root = tree.root_element(use.texture_info);
    if (root == json::kNoNode || tree.name(tree.parent(root)) != "materials") continue;
    TextureUse read;
    read.slot = use.pointer.substr(use.pointer.rfind('/') + 1);
    read.read = model::read_slot(asset, model::Properties(source.document(), use.owner), read.slot);
    if (read.read.texture) materials[tree.position(root)].uses.push_back(std::move(read));
  }
  return materials;
}

std::optional<TextureSize> size_of_texture(const Source& source, std::uint32_t texture) {
  const model::Asset& asset = source.asset();
  const model::Texture read =
      model::read_texture(asset, asset.elements(RootArray::textures)[texture]);
  for (const std::uint32_t image : read.images) {
    const auto& header = source.resources().images[image].header;
    if (header && header->width > 0 && header->height > 0) {
      return TextureSize{header->width, header->height, read.sampler};
    }
  }
  return std::nullopt;
}

}  // namespace gltfx::measure
