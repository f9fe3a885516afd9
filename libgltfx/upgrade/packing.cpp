// SPDX-License-Identifier: Apache-2.0
#include "upgrade/packing.hpp"

#include <array>
#include <cstddef>
#include <vector>

#include <fmt/format.h>

#include "model/fields.hpp"

namespace gltfx::upgrade {
namespace {

constexpr std::string_view kTransform = "KHR_texture_transform";

using Numbers = std::vector<double>;

/// What a texture info says about places, with defaults.
struct Placement {
  std::uint64_t tex_coord = 0;
  Numbers offset{0, 0}, scale{1, 1};
  double rotation = 0;
  bool plain = true;  ///< no extension but the transform
  bool operator==(const Placement&) const = default;
};

void read_pair(const json::Document& document, json::NodeId object, std::string_view name,
               Numbers& to) {
  const json::NodeId list = document.find(object, name);
  if (list == json::kNoNode || document.kind(list) != json::Kind::number_array) return;
  to.clear();
  for (json::NumberCursor at(document, list); at.valid(); at.advance()) {
    to.push_back(at.number().value);
  }
}

Placement placement_of(const json::Document& document, json::NodeId info) {
  Placement placement;
  if (!document.is_object(info)) return placement;
  placement.tex_coord = model::unsigned_member(document, info, "texCoord").value_or(0);
  const json::NodeId extensions = model::object_member(document, info, "extensions");
  if (extensions == json::kNoNode) return placement;
  for (const auto extension : document.members(extensions)) {
    placement.plain = placement.plain && document.key(extension.key_id) == kTransform;
  }
  const json::NodeId transform = model::extension_object(document, info, kTransform);
  if (transform == json::kNoNode) return placement;
  const auto instead = model::unsigned_member(document, transform, "texCoord");
  placement.tex_coord = instead.value_or(placement.tex_coord);
  placement.rotation = model::number_member(document, transform, "rotation").value_or(0);
  read_pair(document, transform, "offset", placement.offset);
  read_pair(document, transform, "scale", placement.scale);
  return placement;
}

/// wrapS, wrapT, minFilter, magFilter; 0 where a renderer may choose.
std::array<std::uint64_t, 4> settings_of(const model::Asset& asset,
                                         std::optional<std::uint64_t> index) {
  constexpr std::uint64_t kRepeat = 10497;
  std::array<std::uint64_t, 4> settings{kRepeat, kRepeat, 0, 0};
  const auto& samplers = asset.elements(model::RootArray::samplers);
  if (!index || *index >= samplers.size()) return settings;
  constexpr std::array<std::string_view, 4> kNames{"wrapS", "wrapT", "minFilter", "magFilter"};
  for (std::size_t i = 0; i < kNames.size(); ++i) {
    const auto value = model::unsigned_member(asset.document(), samplers[*index], kNames[i]);
    settings[i] = value.value_or(settings[i]);
  }
  return settings;
}

}  // namespace

bool lie_alike(const json::Document& document, json::NodeId one, json::NodeId other) {
  const Placement placement = placement_of(document, one);
  return placement.plain && placement == placement_of(document, other);
}

bool sample_alike(const model::Asset& asset, std::optional<std::uint64_t> one,
                  std::optional<std::uint64_t> other) {
  return settings_of(asset, one) == settings_of(asset, other);
}

std::string packing_obstacle(const Picture& colour, const Picture& factor) {
  if (colour.image.bits != 8) return "the color has more than 8 bits";
  if (colour.image.width == factor.image.width && colour.image.height == factor.image.height) {
    return {};
  }
  return fmt::format("the images have {}x{} and {}x{} texels", colour.image.width,
                     colour.image.height, factor.image.width, factor.image.height);
}

}  // namespace gltfx::upgrade
