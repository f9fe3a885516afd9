// SPDX-License-Identifier: Apache-2.0
#include "model/mesh.hpp"

#include <algorithm>
#include <array>

#include "model/fields.hpp"

namespace gltfx::model {
namespace {

constexpr std::array<std::string_view, 7> kModes{
    "POINTS", "LINES", "LINE_LOOP", "LINE_STRIP", "TRIANGLES", "TRIANGLE_STRIP", "TRIANGLE_FAN"};

std::vector<json::NodeId> objects(const json::Document& document, json::NodeId array) {
  std::vector<json::NodeId> found;
  if (array == json::kNoNode || document.kind(array) != json::Kind::array) return found;
  for (const json::NodeId element : document.elements(array)) {
    found.push_back(document.is_object(element) ? element : json::kNoNode);
  }
  return found;
}

}  // namespace

std::string_view mode_name(Mode mode) { return kModes[static_cast<std::size_t>(mode)]; }

std::vector<Attribute> read_attributes(const Asset& asset, json::NodeId object) {
  std::vector<Attribute> attributes;
  const json::Document& document = asset.document();
  if (object == json::kNoNode || !document.is_object(object)) return attributes;
  for (const auto member : document.members(object)) {
    Attribute attribute;
    attribute.name = document.key(member.key_id);
    attribute.semantic = parse_semantic(attribute.name);
    attribute.value = member.value;
    if (document.is_number(member.value)) {
      attribute.accessor = asset.index(document.number(member.value).value, RootArray::accessors);
    }
    attributes.push_back(attribute);
  }
  return attributes;
}

const Attribute* Primitive::find(SemanticKind kind, std::uint64_t set) const {
  const auto at = std::find_if(attributes.begin(), attributes.end(), [&](const Attribute& each) {
    return each.semantic.kind == kind && each.semantic.set == set;
  });
  return at == attributes.end() ? nullptr : &*at;
}

Primitive read_primitive(const Asset& asset, json::NodeId object) {
  const json::Document& document = asset.document();
  Primitive primitive;
  primitive.node = object;
  primitive.attributes_node = object_member(document, object, "attributes");
  primitive.attributes = read_attributes(asset, primitive.attributes_node);
  primitive.targets = morph_targets(document, object);
  primitive.indices_node = document.find(object, "indices");
  primitive.indices = asset.index(object, "indices", RootArray::accessors);
  primitive.material_node = document.find(object, "material");
  primitive.material = asset.index(object, "material", RootArray::materials);
  if (document.find(object, "mode") != json::kNoNode) {
    const auto mode = unsigned_member(document, object, "mode");
    const bool valid = mode && *mode < kModes.size();
    primitive.mode = valid ? std::optional(static_cast<Mode>(*mode)) : std::nullopt;
  }
  return primitive;
}

std::vector<json::NodeId> primitives(const json::Document& document, json::NodeId mesh) {
  return objects(document, document.find(mesh, "primitives"));
}

std::vector<json::NodeId> morph_targets(const json::Document& document, json::NodeId primitive) {
  std::vector<json::NodeId> targets = objects(document, document.find(primitive, "targets"));
  const bool broken = std::any_of(targets.begin(), targets.end(), [&](json::NodeId target) {
    return target == json::kNoNode || document.node(target).next == target + 1;
  });
  return broken ? std::vector<json::NodeId>() : targets;
}

}  // namespace gltfx::model
