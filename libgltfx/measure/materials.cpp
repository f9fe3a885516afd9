// SPDX-License-Identifier: Apache-2.0
// Materials by their members and the headers of their images.
#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include "measure/take.hpp"
#include "model/fields.hpp"
#include "model/texture.hpp"

namespace gltfx::measure {
namespace {

using model::RootArray;

struct MaterialTextures {
  std::uint64_t slots = 0;
  std::uint32_t longest_side = 0;
  bool unread = false;  // the header of an image could not be read
};

std::uint32_t longest_side(const model::ImageData& image) {
  if (image.header) return std::max(image.header->width, image.header->height);
  return image.ktx2 ? std::max(image.ktx2->width, image.ktx2->height) : 0;
}

// The texture slots of all materials, those in extensions included.
std::vector<MaterialTextures> read_textures(const Source& source) {
  const model::Asset& asset = source.asset();
  std::vector<std::vector<std::uint32_t>> images;  // by texture
  for (const json::NodeId texture : asset.elements(RootArray::textures)) {
    images.push_back(texture == json::kNoNode ? std::vector<std::uint32_t>()
                                              : model::read_texture(asset, texture).images);
  }
  std::vector<MaterialTextures> materials(asset.count(RootArray::materials));
  const graph::Tree& tree = source.graph().tree();
  for (const schema::SlotUse& use : source.graph().checked().slots) {
    const json::NodeId root = tree.root_element(use.texture_info);
    if (root == json::kNoNode || tree.name(tree.parent(root)) != "materials") continue;
    MaterialTextures& material = materials[tree.position(root)];
    ++material.slots;
    const auto texture = asset.index(use.texture_info, "index", RootArray::textures);
    if (!texture) continue;
    for (const std::uint32_t image : images[*texture]) {
      const std::uint32_t side = longest_side(source.resources().images[image]);
      material.longest_side = std::max(material.longest_side, side);
      material.unread = material.unread || side == 0;
    }
  }
  return materials;
}

std::vector<std::string> extensions_of(const json::Document& document, json::NodeId object) {
  std::vector<std::string> names;
  const json::NodeId extensions = model::object_member(document, object, "extensions");
  if (extensions == json::kNoNode) return names;
  for (const auto member : document.members(extensions)) {
    names.emplace_back(document.key(member.key_id));
  }
  std::sort(names.begin(), names.end());
  return names;
}

void take_textures(Taking& taking) {
  Column* slots = taking.column(MeasureScope::material, Name::textures);
  Column* sides = taking.column(MeasureScope::material, Name::texture_size);
  if (slots == nullptr && sides == nullptr) return;
  const auto materials = read_textures(taking.source());
  for (std::size_t i = 0; i < materials.size(); ++i) {
    if (slots != nullptr) slots->set(i, materials[i].slots);
    if (sides == nullptr) continue;
    if (materials[i].slots == 0) {
      sides->does_not_apply(i, "The material has no texture.");
    } else if (materials[i].unread) {
      sides->could_not_be_taken(i, "The header of an image could not be read.");
    } else {
      sides->set(i, std::uint64_t{materials[i].longest_side});
    }
  }
}

}  // namespace

void take_materials(Taking& taking) {
  const json::Document& document = taking.source().document();
  const auto& objects = taking.source().asset().elements(RootArray::materials);
  const auto set = [&](Name name, std::size_t material, const auto& value) {
    Column* column = taking.column(MeasureScope::material, name);
    if (column != nullptr) column->set(material, MeasureValue(value()));
  };
  for (std::size_t i = 0; i < objects.size(); ++i) {
    if (objects[i] == json::kNoNode) continue;
    set(Name::alpha_mode, i, [&] {
      const std::string mode = model::string_member(document, objects[i], "alphaMode");
      return mode.empty() ? std::string("OPAQUE") : mode;
    });
    set(Name::double_sided, i,
        [&] { return model::true_member(document, objects[i], "doubleSided"); });
    set(Name::extensions, i, [&] { return extensions_of(document, objects[i]); });
  }
  take_textures(taking);
}

}  // namespace gltfx::measure
