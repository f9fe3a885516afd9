// SPDX-License-Identifier: Apache-2.0
// Features of materials, textures and samplers.
#include <map>
#include <optional>
#include <set>
#include <string_view>

#include "model/fields.hpp"
#include "model/properties.hpp"
#include "model/texture.hpp"
#include "rules/targets/features.hpp"

namespace gltfx::validate {
namespace {

using json::NodeId;
using model::RootArray;

constexpr std::string_view kTransform = "KHR_texture_transform";
constexpr std::string_view kTechniques = "KHR_techniques_webgl";

class MaterialFeatures {
 public:
  MaterialFeatures(const Context& context, Features& features)
      : context_(context), document_(context.document), features_(features) {}

  void find() {
    for (const NodeId material : context_.asset.elements(RootArray::materials)) {
      if (material != json::kNoNode) find_material(material);
    }
    find_slots();
    find_shaders();
    for (const NodeId texture : context_.asset.elements(RootArray::textures)) {
      if (texture != json::kNoNode) find_texture(texture);
    }
  }

 private:
  void note_if(bool has, std::string_view name, NodeId node) { features_.note_if(has, name, node); }

  void find_material(NodeId material) {
    const std::string mode = model::string_member(document_, material, "alphaMode");
    note_if(mode == "MASK", "material.alpha-mask", material);
    note_if(mode == "BLEND", "material.alpha-blend", material);
    const auto cutoff = model::number_member(document_, material, "alphaCutoff");
    note_if(cutoff && *cutoff != 0.5, "material.alpha-cutoff", material);
    note_if(model::true_member(document_, material, "doubleSided"), "material.double-sided",
            material);
    const auto emission =
        model::Properties(document_, material).numbers<3>("emissiveFactor", {0, 0, 0});
    note_if(emission[0] != 0 || emission[1] != 0 || emission[2] != 0, "material.emissive",
            material);
    const NodeId rough = model::object_member(document_, material, "pbrMetallicRoughness");
    find_slot(rough, "baseColorTexture", "material.base-color-texture", material);
    find_slot(rough, "metallicRoughnessTexture", "material.metallic-roughness-texture", material);
    find_slot(material, "emissiveTexture", "material.emissive-texture", material);
    const NodeId normal = find_slot(material, "normalTexture", "material.normal-texture", material);
    const NodeId occlusion =
        find_slot(material, "occlusionTexture", "material.occlusion-texture", material);
    note_if(mode == "BLEND" && has_extension(material, "KHR_materials_sheen") &&
                has_extension(material, "KHR_materials_specular"),
            "material.blended-sheen-specular", material);
    note_if(model::number_member(document_, normal, "scale").value_or(1) != 1,
            "material.normal-scale", material);
    note_if(model::number_member(document_, occlusion, "strength").value_or(1) != 1,
            "material.occlusion-strength", material);
  }

  bool has_extension(NodeId material, std::string_view name) const {
    return model::extension_object(document_, material, name) != json::kNoNode;
  }

  NodeId find_slot(NodeId object, std::string_view member, std::string_view name, NodeId material) {
    const NodeId slot = model::object_member(document_, object, member);
    note_if(slot != json::kNoNode, name, material);
    return slot;
  }

  // Slots of all materials, including those of extensions; slots of one material are consecutive.
  void find_slots() {
    std::string_view material;
    std::optional<model::TextureSlot> first;
    for (const schema::SlotUse& use : context_.checked.slots) {
      const NodeId info = use.texture_info;
      const auto set = model::unsigned_member(document_, info, "texCoord").value_or(0);
      note_if(set == 1, "texture.texcoord-1", info);
      note_if(set >= 2, "texture.texcoord-2", info);
      const NodeId transform = model::extension_object(document_, info, kTransform);
      note_if(model::number_member(document_, transform, "rotation").value_or(0) != 0,
              "texture-transform.rotation", info);
      note_if(document_.find(transform, "texCoord") != json::kNoNode, "texture-transform.texcoord",
              info);
      const model::TextureSlot slot = transform_of(transform);
      const std::string_view owner = material_of(use.pointer);
      if (owner == material && first) {
        note_if(!(slot == *first), "texture-transform.other-slots", info);
      } else {
        material = owner;
        first = slot;
      }
    }
  }

  void find_shaders() {
    const NodeId extension = model::extension_object(document_, document_.root(), kTechniques);
    const NodeId shaders = document_.find(extension, "shaders");
    if (shaders == json::kNoNode || document_.kind(shaders) != json::Kind::array) return;
    for (const NodeId shader : document_.elements(shaders)) {
      note_if(document_.find(shader, "uri") != json::kNoNode, "techniques.shader-uri", shader);
    }
  }

  model::TextureSlot transform_of(NodeId transform) const {
    const model::Properties members(document_, transform);
    model::TextureSlot slot;
    slot.offset = members.numbers<2>("offset", {0, 0});
    slot.rotation = members.number("rotation", 0);
    slot.scale = members.numbers<2>("scale", {1, 1});
    return slot;
  }

  // "/materials/3" of a pointer below it.
  static std::string_view material_of(std::string_view pointer) {
    const std::size_t second = pointer.find('/', 1);
    return pointer.substr(0, pointer.find('/', second + 1));
  }

  void find_texture(NodeId texture) {
    const bool extended = document_.find(texture, "extensions") != json::kNoNode;
    note_if(!extended && document_.find(texture, "source") == json::kNoNode, "texture.no-source",
            texture);
    const auto sampler = context_.asset.index(texture, "sampler", RootArray::samplers);
    if (!sampler) return;
    constexpr std::uint64_t kNearest = 9728;
    constexpr std::uint64_t kLinear = 9729;
    constexpr std::uint64_t kClamp = 33071;
    constexpr std::uint64_t kMirrored = 33648;
    const NodeId object = context_.asset.elements(RootArray::samplers)[*sampler];
    for (const std::string_view member : {"wrapS", "wrapT"}) {
      const auto wrap = model::unsigned_member(document_, object, member);
      note_if(wrap == kClamp, "texture.sampler-clamp", object);
      note_if(wrap == kMirrored, "texture.sampler-mirrored", object);
    }
    note_if(model::unsigned_member(document_, object, "magFilter") == kNearest,
            "texture.sampler-nearest", object);
    const auto filter = model::unsigned_member(document_, object, "minFilter");
    note_if(filter == kNearest || filter == kLinear, "texture.sampler-no-mipmaps", object);
  }

  const Context& context_;
  const json::Document& document_;
  Features& features_;
};

}  // namespace

void find_material_features(const Context& context, Features& features) {
  MaterialFeatures(context, features).find();
}

}  // namespace gltfx::validate
