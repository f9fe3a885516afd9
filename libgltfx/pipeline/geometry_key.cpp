// SPDX-License-Identifier: Apache-2.0
#include "pipeline/geometry_key.hpp"

#include <algorithm>

#include "base/bit_cast.hpp"
#include "model/draco.hpp"

namespace gltfx {
namespace {

constexpr std::uint64_t kAbsent = UINT64_MAX;

void add_attributes(const model::GeometrySource& source,
                    const std::vector<model::Attribute>& attributes,
                    const std::optional<model::DracoReference>& packed, GeometryKey& key) {
  for (const model::Attribute& each : attributes) {
    if (static_cast<std::size_t>(each.semantic.kind) >= model::kCoreSemanticCount) continue;
    const auto id = packed ? model::draco_id(source.asset, *packed, each.name) : std::nullopt;
    key.insert(key.end(), {static_cast<std::uint64_t>(each.semantic.kind), each.semantic.set,
                           each.accessor ? *each.accessor : kAbsent, id.value_or(kAbsent)});
  }
  key.push_back(kAbsent);
}

}  // namespace

GeometryKey geometry_key(const model::GeometrySource& source, const model::Primitive& primitive,
                         const PrimitivePose& pose, const MaterialNeeds& needs) {
  const auto packed = model::read_draco(source.asset, primitive);
  const bool indexed = primitive.indices_node != json::kNoNode;
  GeometryKey key{primitive.mode ? static_cast<std::uint64_t>(*primitive.mode) : kAbsent,
                  std::uint64_t{indexed}, primitive.indices ? *primitive.indices : kAbsent,
                  packed ? packed->buffer_view : kAbsent, pose.skin};
  add_attributes(source, primitive.attributes, packed, key);
  for (std::size_t i = 0; i < std::min(pose.weights.size(), primitive.targets.size()); ++i) {
    if (pose.weights[i] == 0) continue;
    key.push_back(bit_cast<std::uint32_t>(pose.weights[i]));
    add_attributes(source, model::read_attributes(source.asset, primitive.targets[i]), std::nullopt,
                   key);
  }
  key.push_back(kAbsent);
  key.insert(key.end(), needs.tex_coords.begin(), needs.tex_coords.end());
  key.push_back(kAbsent);
  if (!needs.tangents) return key;
  key.push_back(needs.tangents->uv_set);
  for (const Float3& row : needs.tangents->transform) {
    for (const float number : row) key.push_back(bit_cast<std::uint32_t>(number));
  }
  return key;
}

KeptGeometry::KeptGeometry(const model::Views& views) : users_(views.accessors.size(), 0) {
  for (const model::Mesh& mesh : views.meshes) {
    for (const model::Primitive& primitive : mesh.primitives) {
      const model::Attribute* positions = primitive.find(model::SemanticKind::position);
      if (positions != nullptr && positions->accessor) ++users_[*positions->accessor];
    }
  }
}

bool KeptGeometry::may_repeat(const model::Primitive& primitive) const {
  const model::Attribute* positions = primitive.find(model::SemanticKind::position);
  return positions != nullptr && positions->accessor && users_[*positions->accessor] > 1;
}

const KeptGeometry::Entry* KeptGeometry::find(const GeometryKey& key) const {
  const auto known = known_.find(key);
  return known == known_.end() ? nullptr : &known->second;
}

}  // namespace gltfx
