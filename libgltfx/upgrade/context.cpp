// SPDX-License-Identifier: Apache-2.0
#include "upgrade/context.hpp"

#include <algorithm>

#include <fmt/format.h>

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

std::string Carrier::pointer() const {
  if (array.empty()) return {};
  return single ? fmt::format("/{}", array) : fmt::format("/{}/{}", array, index);
}

bool Context::has_beside(const Carrier& carrier, const std::string& extension) const {
  if (given.count({carrier.host, extension}) > 0) return true;
  const json::NodeId value = document.find(carrier.extensions, extension);
  return value != json::kNoNode && gone.count(value) == 0;
}

Origin Context::origin_of(const Carrier& carrier, const std::string& path) const {
  const auto elsewhere = moved.find({carrier.host, path});
  if (elsewhere != moved.end()) return elsewhere->second;
  std::vector<std::string> steps = split_path(path);
  const json::NodeId value = find_path(document, carrier.host, steps);
  return {value, std::move(steps)};
}

bool Context::is_used_with(const std::string& attribute, std::uint64_t material) {
  auto users = attribute_users.find(attribute);
  if (users == attribute_users.end()) {
    users = attribute_users.emplace(attribute, users_of(asset, attribute)).first;
  }
  return users->second.count(material) > 0;
}

std::vector<std::string> split_path(std::string_view path) {
  std::vector<std::string> steps;
  while (true) {
    const std::size_t end = std::min(path.find('/'), path.size());
    steps.emplace_back(path.substr(0, end));
    if (end == path.size()) return steps;
    path.remove_prefix(end + 1);
  }
}

json::NodeId find_path(const json::Document& document, json::NodeId object,
                       std::span<const std::string> path) {
  for (const std::string& name : path) object = document.find(object, name);
  return object;
}

}  // namespace gltfx::upgrade
