// SPDX-License-Identifier: Apache-2.0
#include "upgrade/context.hpp"

#include "model/mesh.hpp"

namespace gltfx::upgrade {
namespace {

// Every member "material" below a primitive counts: extensions name further ones by mappings.
void add_materials(const json::Document& document, json::NodeId primitive,
                   std::unordered_set<std::uint64_t>& materials) {
  const json::KeyId name = document.key_id("material");
  for (json::NodeId id = primitive; id < document.next(primitive); ++id) {
    const json::Node& node = document.node(id);
    if (node.kind != json::Kind::key || node.next != name) continue;
    if (!document.is_number(id + 1)) continue;
    if (const auto index = document.unsigned_integer(id + 1)) materials.insert(*index);
  }
}

std::unordered_set<std::uint64_t> users_of(const model::Asset& asset,
                                           const std::string& attribute) {
  std::unordered_set<std::uint64_t> materials;
  const json::Document& document = asset.document();
  for (const json::NodeId mesh : asset.elements(model::RootArray::meshes)) {
    if (mesh == json::kNoNode) continue;
    for (const json::NodeId primitive : model::primitives(document, mesh)) {
      if (primitive == json::kNoNode) continue;
      const json::NodeId attributes = document.find(primitive, "attributes");
      if (document.find(attributes, attribute) == json::kNoNode) continue;
      add_materials(document, primitive, materials);
    }
  }
  return materials;
}

}  // namespace

bool Context::is_used_with(const std::string& attribute, std::uint64_t material) {
  auto users = attribute_users.find(attribute);
  if (users == attribute_users.end()) {
    users = attribute_users.emplace(attribute, users_of(asset, attribute)).first;
  }
  return users->second.count(material) > 0;
}

}  // namespace gltfx::upgrade
