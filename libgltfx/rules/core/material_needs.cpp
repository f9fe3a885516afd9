// SPDX-License-Identifier: Apache-2.0
#include "rules/core/material_needs.hpp"

#include <charconv>

#include "model/fields.hpp"
#include "model/texture.hpp"

namespace gltfx::validate {

VertexAlpha::VertexAlpha(const Context& context) {
  for (const model::Mesh& mesh : context.views.meshes) {
    for (const model::Primitive& primitive : mesh.primitives) add(context, primitive);
  }
}

void VertexAlpha::add(const Context& context, const model::Primitive& primitive) {
  const auto* color = primitive.find(model::SemanticKind::color);
  if (color == nullptr || !color->accessor) return;
  const model::Accessor& accessor = context.views.accessors[*color->accessor];
  if (accessor.format.type != model::ElementType::vec4) return;
  if (primitive.material) materials_.insert(*primitive.material);
  any_ = any_ || context.document.find(primitive.node, "extensions") != json::kNoNode;
}

std::optional<std::uint64_t> material_of(std::string_view pointer) {
  constexpr std::string_view kArray = "/materials/";
  if (!pointer.starts_with(kArray)) return std::nullopt;
  pointer.remove_prefix(kArray.size());
  std::uint64_t index = 0;
  const auto end = std::from_chars(pointer.data(), pointer.data() + pointer.size(), index);
  return end.ec == std::errc() ? std::optional(index) : std::nullopt;
}

namespace {

// Directions of anisotropy are also vectors in tangent space.
bool in_tangent_space(std::string_view property) {
  return model::is_normal_map(property) || property == "anisotropyTexture";
}

}  // namespace

MaterialNeeds::MaterialNeeds(const Context& context, const ActiveExtensions& active)
    : needs_(context.asset.count(model::RootArray::materials)) {
  for (const schema::SlotUse& use : context.checked.slots) add(context, active, use);
  if (!context.deviations.fewer_materials_need_tangents) add_directions(context);
}

// Anisotropic highlights need a tangent space, with or without a texture.
void MaterialNeeds::add_directions(const Context& context) {
  const auto& materials = context.asset.elements(model::RootArray::materials);
  for (std::size_t i = 0; i < materials.size(); ++i) {
    const json::NodeId object =
        model::extension_object(context.document, materials[i], "KHR_materials_anisotropy");
    const auto strength = model::number_member(context.document, object, "anisotropyStrength");
    if (!strength || !(*strength > 0)) continue;
    needs_[i].tangent_space = true;
  }
}

void MaterialNeeds::add(const Context& context, const ActiveExtensions& active,
                        const schema::SlotUse& use) {
  const auto index = material_of(use.pointer);
  if (!index || *index >= needs_.size()) return;
  MaterialNeed& need = needs_[*index];
  const std::string_view pointer = use.pointer;
  const std::string_view property = pointer.substr(pointer.rfind('/') + 1);
  if (in_tangent_space(property)) need.tangent_space = true;
  // Only the core normal texture requires tangents; other encodings of normals do not.
  if (property == "normalTexture") need.normal_texture = true;

  const json::Document& document = context.document;
  const auto set = model::unsigned_member(document, use.texture_info, "texCoord");
  const bool sound = set || !document.has_value(use.texture_info, "texCoord");
  if (sound) need.texcoords.push_back({use.pointer, set.value_or(0)});
  const json::NodeId extensions = model::object_member(document, use.texture_info, "extensions");
  if (extensions == json::kNoNode) return;
  for (const auto member : document.members(extensions)) {
    const std::string_view name = document.key(member.key_id);
    if (!document.is_object(member.value) || !active.contains(name)) continue;
    const auto other = model::unsigned_member(document, member.value, "texCoord");
    if (other) need.texcoords.push_back({use.pointer + "/extensions/" + std::string(name), *other});
  }
}

}  // namespace gltfx::validate
