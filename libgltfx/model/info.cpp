// SPDX-License-Identifier: Apache-2.0
#include "model/info.hpp"

#include <algorithm>
#include <optional>
#include <string>

#include "base/checked.hpp"
#include "model/fields.hpp"

namespace gltfx::model {
namespace {

// The strings of a root array, once each, in its order.
std::vector<std::string> string_list(const json::Document& document, std::string_view member) {
  std::vector<std::string> list;
  const json::NodeId array = document.find(document.root(), member);
  if (array == json::kNoNode || document.kind(array) != json::Kind::array) return list;
  json::KeyTable seen;
  for (const json::NodeId element : document.elements(array)) {
    if (document.is_string(element) && document.insert_string(element, seen))
      list.push_back(document.string(element));
  }
  return list;
}

// Number of sets of an indexed semantic; 0 if there is a gap.
std::uint64_t set_count(const Primitive& primitive, SemanticKind kind) {
  std::uint64_t count = 0, highest = 0;
  for (const Attribute& attribute : primitive.attributes) {
    if (attribute.semantic.kind != kind) continue;
    ++count;
    highest = std::max(highest, attribute.semantic.set);
  }
  return count > 0 && highest == count - 1 ? count : 0;
}

std::uint64_t triangles(std::uint64_t count, Mode mode) {
  if (mode == Mode::triangles) return count / 3;
  const bool chained = mode == Mode::triangle_strip || mode == Mode::triangle_fan;
  return chained && count > 2 ? count - 2 : 0;
}

void add_primitive(const Views& views, const Primitive& primitive, AssetInfo& info) {
  ++info.draw_call_count;
  const PrimitiveSize size = primitive_size(views, primitive);
  info.total_vertex_count = saturating_add(info.total_vertex_count, size.vertices);
  info.total_triangle_count = saturating_add(info.total_triangle_count, size.triangles);
  std::uint64_t attributes = 0;
  for (const Attribute& attribute : primitive.attributes)
    attributes += attribute.accessor ? 1U : 0U;
  const std::uint64_t joints = set_count(primitive, SemanticKind::joints);
  const bool skinned = joints == set_count(primitive, SemanticKind::weights);
  info.max_influences = std::max(info.max_influences, skinned ? joints * 4 : 0);
  info.max_uvs = std::max(info.max_uvs, set_count(primitive, SemanticKind::texcoord));
  info.max_attributes = std::max(info.max_attributes, attributes);
  info.has_morph_targets = info.has_morph_targets || !primitive.targets.empty();
}

}  // namespace

PrimitiveSize primitive_size(const Views& views, const Primitive& primitive) {
  std::optional<std::uint64_t> vertices;
  for (const Attribute& attribute : primitive.attributes) {
    if (!attribute.accessor) continue;
    vertices = views.accessors[*attribute.accessor].count;
    if (vertices) break;
  }
  const auto drawn = primitive.indices ? views.accessors[*primitive.indices].count : vertices;
  PrimitiveSize size;
  size.vertices = vertices.value_or(0);
  if (drawn && primitive.mode) size.triangles = triangles(*drawn, *primitive.mode);
  return size;
}

std::uint64_t vertex_bytes(const Views& views, const Primitive& primitive) {
  std::uint64_t bytes = 0;
  for (const Attribute& attribute : primitive.attributes) {
    if (attribute.accessor) bytes += packed_stride(views.accessors[*attribute.accessor].format);
  }
  return bytes;
}

AssetInfo asset_info(const Asset& asset, const Views& views) {
  AssetInfo info;
  const json::Document& document = asset.document();
  if (document.empty() || !document.is_object(document.root())) return info;
  const json::NodeId header = object_member(document, document.root(), "asset");
  info.version = string_member(document, header, "version");
  info.min_version = string_member(document, header, "minVersion");
  const json::NodeId generator = document.find(header, "generator");
  if (generator != json::kNoNode && document.is_string(generator))
    info.generator = document.string(generator);
  info.extensions_used = string_list(document, "extensionsUsed");
  info.extensions_required = string_list(document, "extensionsRequired");
  info.animation_count = asset.count(RootArray::animations);
  info.material_count = asset.count(RootArray::materials);
  info.has_skins = asset.count(RootArray::skins) > 0;
  info.has_textures = asset.count(RootArray::textures) > 0;
  info.has_default_scene = asset.index(document.root(), "scene", RootArray::scenes).has_value();
  for (const Mesh& mesh : views.meshes) {
    for (const Primitive& primitive : mesh.primitives) {
      if (primitive.node != json::kNoNode) add_primitive(views, primitive, info);
    }
  }
  return info;
}

}  // namespace gltfx::model
