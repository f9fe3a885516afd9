// SPDX-License-Identifier: Apache-2.0
#include "steps/attribute_roles.hpp"

#include <fmt/format.h>

#include "base/text.hpp"
#include "graph/unknown_indices.hpp"
#include "model/draco.hpp"
#include "model/fields.hpp"
#include "steps/view_pool.hpp"

namespace gltfx::steps {

using model::SemanticKind;

AttributeLists attribute_lists(const model::Asset& asset, const model::Primitive& primitive) {
  AttributeLists lists{primitive.attributes, {}};
  for (const json::NodeId target : primitive.targets) {
    lists.targets.push_back(model::read_attributes(asset, target));
  }
  return lists;
}

AttributeRoles::AttributeRoles(const StepData& data)
    : data_(data), roles_(data.views.accessors.size()), meant_(unknown_integers(data.graph)) {
  for (const model::Mesh& mesh : data.views.meshes) {
    for (const model::Primitive& primitive : mesh.primitives) {
      if (primitive.node == json::kNoNode) continue;
      const bool is_coded = model::extension_object(data.document, primitive.node,
                                                    model::kDracoExtension) != json::kNoNode;
      const AttributeLists lists = attribute_lists(data.asset, primitive);
      note(lists.own, false, is_coded);
      for (const auto& target : lists.targets) note(target, true, is_coded);
      if (primitive.indices) roles_[*primitive.indices].is_mixed = true;
    }
  }
}

void AttributeRoles::note(const std::vector<model::Attribute>& attributes, bool of_target,
                          bool is_coded) {
  for (const model::Attribute& attribute : attributes) {
    if (!attribute.accessor) continue;
    AttributeRole& role = roles_[*attribute.accessor];
    const bool is_other =
        role.uses > 0 && (role.kind != attribute.semantic.kind || role.of_target != of_target);
    role.kind = attribute.semantic.kind;
    role.of_target = of_target;
    role.is_mixed |= is_other;
    role.is_coded |= is_coded;
    ++role.uses;
  }
}

bool AttributeRoles::is_float(std::uint32_t accessor) const {
  return data_.views.accessors[accessor].format.component == model::ComponentType::float32;
}

std::string AttributeRoles::find_obstacle(std::uint32_t accessor) const {
  const AttributeRole& role = roles_[accessor];
  if (role.is_coded) return "is compressed; decode it first: --compress none";
  if (role.is_mixed) return "has an accessor that is used in several ways";
  if (data_.graph.users(data_.views.accessors[accessor].node).size() != role.uses)
    return "shares an accessor with objects other than primitives";
  return {};
}

std::string AttributeRoles::find_unknown(std::uint32_t index) const {
  if (!meant_.contains(index)) return {};
  const json::NodeId unknown = graph::find_unknown_with_integer(data_.graph);
  return fmt::format("{} may hold its index (describe it with --schema)",
                     printable(data_.pointer(unknown)));
}

}  // namespace gltfx::steps
