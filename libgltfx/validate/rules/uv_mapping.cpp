// SPDX-License-Identifier: Apache-2.0
#include "validate/rules/uv_mapping.hpp"

#include "model/fields.hpp"

namespace gltfx::validate {
namespace {

void read_pair(const json::Document& document, json::NodeId object, std::string_view member,
               std::array<double, 2>& pair) {
  const json::NodeId value = document.find(object, member);
  if (value == json::kNoNode || document.kind(value) != json::Kind::number_array) return;
  std::size_t at = 0;
  for (json::NumberCursor number(document, value); number.valid() && at < 2; number.advance()) {
    pair[at++] = number.number().value;
  }
}

// `object` is an extension of the texture info.
void read_transform(const json::Document& document, json::NodeId object, UvMapping& mapping) {
  const auto set = model::number_member(document, object, "texCoord");
  mapping.texcoord = set.value_or(mapping.texcoord);
  const auto rotation = model::number_member(document, object, "rotation");
  mapping.rotation = rotation.value_or(mapping.rotation);
  read_pair(document, object, "offset", mapping.offset);
  read_pair(document, object, "scale", mapping.scale);
}

}  // namespace

std::string_view UvMapping::difference(const UvMapping& other) const {
  if (texcoord != other.texcoord) return "texCoord";
  const bool same = rotation == other.rotation && offset == other.offset && scale == other.scale;
  return same ? "" : "transform";
}

UvMapping read_uv_mapping(const json::Document& document, json::NodeId texture_info) {
  UvMapping mapping;
  mapping.texcoord = model::number_member(document, texture_info, "texCoord").value_or(0);
  const json::NodeId extensions = model::object_member(document, texture_info, "extensions");
  if (extensions == json::kNoNode) return mapping;
  for (const auto member : document.members(extensions)) {
    if (document.is_object(member.value)) read_transform(document, member.value, mapping);
  }
  return mapping;
}

}  // namespace gltfx::validate
