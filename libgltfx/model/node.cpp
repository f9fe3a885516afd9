// SPDX-License-Identifier: Apache-2.0
#include "model/node.hpp"

#include <algorithm>
#include <cmath>
#include <string_view>
#include <utility>

namespace gltfx::model {
namespace {

constexpr std::array<float, 16> kIdentity{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};

std::optional<std::uint32_t> index_of(const Asset& asset, json::NodeId value, RootArray array) {
  const json::Document& document = asset.document();
  if (value == json::kNoNode || !document.is_number(value)) return std::nullopt;
  return asset.index(document.number(value).value, array);
}

using Field = json::NodeId Node::*;
constexpr std::pair<std::string_view, Field> kFields[] = {
    {"mesh", &Node::mesh_value},
    {"children", &Node::children},
    {"translation", &Node::translation},
    {"rotation", &Node::rotation},
    {"scale", &Node::scale},
    {"matrix", &Node::matrix},
    {"skin", &Node::skin_value},
    {"camera", &Node::camera_value},
    {"weights", &Node::weights},
    {"extensions", &Node::extensions},
    {"extras", &Node::extras},
};

// By KeyId: the field that a member of that name fills, or null. Large files have a million nodes.
std::vector<Field> fields_by_key(const json::Document& document) {
  std::vector<Field> fields(document.key_count(), nullptr);
  for (const auto& [name, field] : kFields) {
    const json::KeyId key = document.key_id(name);
    if (key != json::kNoKey) fields[key] = field;
  }
  return fields;
}

void read_indices(const Asset& asset, Node& node) {
  node.mesh = index_of(asset, node.mesh_value, RootArray::meshes);
  node.camera = index_of(asset, node.camera_value, RootArray::cameras);
  node.skin = index_of(asset, node.skin_value, RootArray::skins);
}

template <std::size_t N>
bool is_absent_or(const std::optional<std::array<float, N>>& value,
                  const std::array<float, N>& neutral) {
  return !value || *value == neutral;
}

}  // namespace

Node read_node(const Asset& asset, json::NodeId object) {
  Node node;
  node.object = object;
  if (object == json::kNoNode) return node;
  const json::Document& document = asset.document();
  for (const auto member : document.members(object)) {
    const std::string_view name = document.key(member.key_id);
    const auto* const field = std::find_if(std::begin(kFields), std::end(kFields),
                                           [&](const auto& each) { return each.first == name; });
    if (field != std::end(kFields)) node.*(field->second) = member.value;
  }
  read_indices(asset, node);
  return node;
}

std::vector<Node> read_nodes(const Asset& asset) {
  const json::Document& document = asset.document();
  const std::vector<Field> fields = fields_by_key(document);
  std::vector<Node> nodes(asset.count(RootArray::nodes));
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    Node& node = nodes[i];
    node.object = asset.elements(RootArray::nodes)[i];
    if (node.object == json::kNoNode) continue;
    for (const auto member : document.members(node.object)) {
      if (const Field field = fields[member.key_id]) node.*field = member.value;
    }
    read_indices(asset, node);
  }
  return nodes;
}

bool read_floats(const json::Document& document, json::NodeId array, std::size_t count,
                 float* values, double least, double most) {
  if (array == json::kNoNode || document.kind(array) != json::Kind::number_array) return false;
  std::size_t filled = 0;
  for (json::NumberCursor at(document, array); at.valid(); at.advance()) {
    const double value = at.number().value;
    if (filled == count || !std::isfinite(value) || value < least || value > most) return false;
    values[filled++] = static_cast<float>(value);
  }
  return filled == count;
}

Transform read_transform(const json::Document& document, const Node& node) {
  Transform transform;
  transform.matrix = float_array<16>(document, node.matrix);
  transform.translation = float_array<3>(document, node.translation);
  transform.rotation = float_array<4>(document, node.rotation, -1, 1);
  transform.scale = float_array<3>(document, node.scale);
  return transform;
}

bool Transform::is_identity() const {
  return is_absent_or(matrix, kIdentity) && is_absent_or(translation, {0, 0, 0}) &&
         is_absent_or(rotation, {0, 0, 0, 1}) && is_absent_or(scale, {1, 1, 1});
}

}  // namespace gltfx::model
