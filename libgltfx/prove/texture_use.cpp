// SPDX-License-Identifier: Apache-2.0
#include "prove/texture_use.hpp"

#include <algorithm>

#include "image/header.hpp"
#include "model/fields.hpp"
#include "model/image_sides.hpp"
#include "model/material.hpp"
#include "model/texture.hpp"

namespace gltfx::prove {
namespace {

using model::RootArray;

// Of one texture, for different readers.
std::vector<std::uint32_t> images_of(const Side& side, json::NodeId texture_info) {
  const auto texture = side.asset().index(texture_info, "index", RootArray::textures);
  if (!texture) return {};
  return model::read_texture(side.asset(), side.asset().elements(RootArray::textures)[*texture])
      .images;
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

// The channels that its material reads.
void note_channels(const Side& side, const schema::SlotUse& slot, ImageUse& use) {
  bool alpha = true;
  if (schema::has_coverage(side.graph().set(), slot)) {
    const json::NodeId material = side.tree().root_element(slot.texture_info);
    const std::string mode = model::string_member(side.document(), material, "alphaMode");
    alpha = mode == "MASK" || mode == "BLEND";
    if (mode == "MASK") {
      const double cutoff =
          model::number_member(side.document(), material, "alphaCutoff").value_or(0.5);
      use.cutoff = std::min(use.cutoff.value_or(cutoff), cutoff);
    }
  }
  for (const char channel : slot.slot->channels) {
    const std::size_t at = std::string_view("rgba").find(channel);
    if (at != std::string_view::npos && (at < 3 || alpha)) use.channels[at] = true;
  }
}

}  // namespace

bool TextureUse::reads(const SoupStream& stream) const {
  switch (stream.kind) {
    case model::SemanticKind::texcoord:
      return sets.contains(stream.set);
    case model::SemanticKind::tangent:
      return normals_mapped && !unlit;
    case model::SemanticKind::normal:
      return !unlit;
    case model::SemanticKind::color:
      return stream.set == 0;
    case model::SemanticKind::application:
    case model::SemanticKind::invalid:
      return false;
    default:
      return true;
  }
}

unsigned TextureUse::read_width(const SoupStream& stream) const {
  const bool color = stream.kind == model::SemanticKind::color;
  return color && opaque ? std::min(stream.width, 3U) : stream.width;
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
    for (const std::uint32_t image : images_of(side, slot.texture_info)) {
      const auto& header = side.resources().images[image].header;
      std::uint32_t& most = longest[item.index];
      if (header) most = std::max({most, header->width, header->height});
    }
  }
  const double usual = model::longest_image_side(side.resources());
  for (std::uint32_t i = 0; i < uses.size(); ++i) {
    uses[i].texels = longest[i] > 0 ? longest[i] : usual;
    if (i + 1 == uses.size()) break;
    const model::Material material = model::read_material(side.asset(), i);
    uses[i].unlit = material.unlit;
    uses[i].opaque = material.alpha_mode == model::AlphaMode::opaque;
  }
  return uses;
}

std::vector<ImageUse> image_uses(const Content& content) {
  const Side& side = content.side();
  std::vector<ImageUse> uses(side.asset().count(RootArray::images));
  for (const schema::SlotUse& slot : side.graph().checked().slots) {
    if (slot.slot == nullptr) continue;
    const graph::Tree& tree = side.tree();
    const bool normal =
        tree.is_member(slot.texture_info) && model::is_normal_map(tree.name(slot.texture_info));
    for (const std::uint32_t image : images_of(side, slot.texture_info)) {
      ImageUse& use = uses[image];
      (normal ? use.normal : slot.slot->srgb ? use.color : use.data) = true;
      note_channels(side, slot, use);
    }
  }
  return uses;
}

}  // namespace gltfx::prove
