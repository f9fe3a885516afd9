// SPDX-License-Identifier: Apache-2.0
// Materials by their members and the headers of their images.
#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include "measure/take.hpp"
#include "measure/texture_uses.hpp"
#include "model/fields.hpp"

namespace gltfx::measure {
namespace {

using model::RootArray;

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

// The longest side of the textures; nothing: the header of an image could not be read.
std::optional<std::uint64_t> longest_side(const Source& source, const MaterialTextures& textures) {
  std::uint64_t longest = 0;
  for (const TextureUse& use : textures.uses) {
    const auto size = size_of_texture(source, *use.read.texture);
    if (!size) return std::nullopt;
    longest = std::max<std::uint64_t>({longest, size->width, size->height});
  }
  return longest;
}

void take_textures(Taking& taking) {
  Column* slots = taking.column(MeasureScope::material, Name::textures);
  Column* sides = taking.column(MeasureScope::material, Name::texture_size);
  if (slots == nullptr && sides == nullptr) return;
  const auto materials = material_textures(taking.source());
  for (std::size_t i = 0; i < materials.size(); ++i) {
    if (slots != nullptr) slots->set(i, std::uint64_t{materials[i].uses.size()});
    if (sides == nullptr) continue;
    if (materials[i].uses.empty()) {
      sides->does_not_apply(i, "The material has no texture.");
    } else if (const auto side = longest_side(taking.source(), materials[i])) {
      sides->set(i, *side);
    } else {
      sides->could_not_be_taken(i, "The header of an image could not be read.");
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
