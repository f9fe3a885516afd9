// SPDX-License-Identifier: Apache-2.0
#include "prove/texture_use.hpp"

#include <algorithm>

#include "image/header.hpp"
#include "model/texture.hpp"

namespace gltfx::prove {
namespace {

using model::RootArray;

std::optional<std::uint32_t> image_of(const Side& side, json::NodeId texture_info) {
  const auto texture = side.asset().index(texture_info, "index", RootArray::textures);
  if (!texture) return std::nullopt;
  const auto images =
      model::read_texture(side.asset(), side.asset().elements(RootArray::textures)[*texture])
          .images;
  return images.empty() ? std::nullopt : std::optional(images.front());
}

// Its own, or that of an extension on it.
std::uint64_t set_of(const Side& side, json::NodeId texture_info) {
  const json::Document& document = side.document();
  const auto read = [&](json::NodeId object) -> std::optional<std::uint64_t> {
    const json::NodeId value = document.find(object, "texCoord");
    return value == json::kNoNode ? std::nullopt : document.unsigned_integer(value);
  };
  const json::NodeId extensions = document.find(texture_info, "extensions");
  if (extensions != json::kNoNode && document.is_object(extensions)) {
    for (const auto member : document.members(extensions)) {
      if (const auto set = read(member.value)) return *set;
    }
  }
  return read(texture_info).value_or(0);
}

}  // namespace

bool TextureUse::reads(const SoupStream& stream) const {
  switch (stream.kind) {
    case model::SemanticKind::texcoord:
      return sets.contains(stream.set);
    case model::SemanticKind::tangent:
      return normals_mapped;
    case model::SemanticKind::color:
      return stream.set == 0;
    case model::SemanticKind::application:
    case model::SemanticKind::invalid:
      return false;
    default:
      return true;
  }
}

std::vector<TextureUse> texture_uses(const Content& content) {
  const Side& side = content.side();
  const graph::Tree& tree = side.tree();
  std::vector<TextureUse> uses(side.asset().count(RootArray::materials) + 1);
  std::vector<std::uint32_t> longest(uses.size());
  const std::uint32_t materials = content.list("/materials");
  for (const schema::SlotUse& slot : side.graph().checked().slots) {
    const ItemId item = content.find(tree.root_element(slot.texture_info));
    if (!item || item.list != materials) continue;
    TextureUse& use = uses[item.index];
    use.sets.insert(set_of(side, slot.texture_info));
    if (tree.is_member(slot.texture_info)) {
      use.normals_mapped |= model::is_normal_map(tree.name(slot.texture_info));
    }
    if (const auto image = image_of(side, slot.texture_info)) {
      const auto& header = side.resources().images[*image].header;
      std::uint32_t& most = longest[item.index];
      if (header) most = std::max({most, header->width, header->height});
    }
  }
  for (std::size_t i = 0; i < uses.size(); ++i) {
    if (longest[i] > 0) uses[i].texels = longest[i];
  }
  return uses;
}

std::vector<ImageUse> image_uses(const Content& content) {
  const Side& side = content.side();
  std::vector<ImageUse> uses(side.asset().count(RootArray::images));
  for (const schema::SlotUse& slot : side.graph().checked().slots) {
    const auto image = image_of(side, slot.texture_info);
    if (!image || slot.slot == nullptr) continue;
    ImageUse& use = uses[*image];
    const graph::Tree& tree = side.tree();
    const bool normal =
        tree.is_member(slot.texture_info) && model::is_normal_map(tree.name(slot.texture_info));
    (normal ? use.normal : slot.slot->srgb ? use.color : use.data) = true;
    for (const char channel : slot.slot->channels) {
      const std::size_t at = std::string_view("rgba").find(channel);
      if (at != std::string_view::npos) use.channels[at] = true;
    }
  }
  return uses;
}

}  // namespace gltfx::prove
