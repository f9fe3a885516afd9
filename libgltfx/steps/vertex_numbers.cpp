// SPDX-License-Identifier: Apache-2.0
// Finds extensions that refer to vertices or triangles by number.
#include <algorithm>
#include <initializer_list>
#include <string_view>

#include <fmt/format.h>

#include "base/text.hpp"
#include "model/fields.hpp"
#include "steps/vertex_sets.hpp"

namespace gltfx::steps {
namespace {

using json::NodeId;

// Extensions whose feature ids may be vertex numbers.
constexpr std::string_view kFeatures = "EXT_mesh_features";
constexpr std::string_view kOldFeatures = "EXT_feature_metadata";

bool has_any(const json::Document& document, NodeId object,
             std::initializer_list<std::string_view> names) {
  return std::any_of(names.begin(), names.end(), [&](std::string_view name) {
    return document.find(object, name) != json::kNoNode;
  });
}

// Whether `is_implied` is true for an element of a list.
template <class IsImplied>
bool any_element(const json::Document& document, NodeId object, std::string_view list,
                 const IsImplied& is_implied) {
  const NodeId array = document.find(object, list);
  if (array == json::kNoNode || !document.is_array(array)) return false;
  for (NodeId id = array + 1; id < document.next(array); id = document.next(id)) {
    if (document.is_object(id) && is_implied(id)) return true;
  }
  return false;
}

bool has_implied_ids(const json::Document& document, std::string_view name, NodeId object) {
  if (name == kFeatures) {
    return any_element(document, object, "featureIds", [&](NodeId ids) {
      return !has_any(document, ids, {"attribute", "texture"});
    });
  }
  if (name != kOldFeatures) return false;
  return any_element(document, object, "featureIdAttributes", [&](NodeId attribute) {
    const NodeId ids = model::object_member(document, attribute, "featureIds");
    return ids != json::kNoNode && !has_any(document, ids, {"attribute"});
  });
}

}  // namespace

VertexNumbers::VertexNumbers(const StepData& data)
    : data_(data),
      accessors_(data.document.find(data.document.root(), "accessors")),
      unknown_(data.graph.unknown_extensions()) {
  std::sort(unknown_.begin(), unknown_.end());
}

std::string VertexNumbers::find(const VertexSet& set) {
  for (const model::Primitive* primitive : set.primitives) {
    if (std::string why = in_extensions(primitive->node, true); !why.empty()) return why;
    const graph::Tree& tree = data_.graph.tree();
    const NodeId mesh = tree.parent(tree.parent(primitive->node));
    const auto [known, is_new] = meshes_.try_emplace(mesh);
    if (is_new) known->second = in_extensions(mesh, false);
    if (!known->second.empty()) return known->second;
  }
  return {};
}

std::string VertexNumbers::in_extensions(NodeId object, bool is_primitive) const {
  const json::Document& document = data_.document;
  const NodeId extensions = model::object_member(document, object, "extensions");
  if (extensions == json::kNoNode) return {};
  for (const auto member : document.members(extensions)) {
    const std::string name = printable(document.key(member.key_id));
    if (refers_to_accessors(member.value))
      return fmt::format("{} has data about its vertices", name);
    if (!is_primitive) continue;
    if (std::binary_search(unknown_.begin(), unknown_.end(), member.value))
      return fmt::format("{} may hold indices of its vertices (describe it with --schema)", name);
    if (document.is_object(member.value) &&
        has_implied_ids(document, document.key(member.key_id), member.value))
      return fmt::format("{} uses vertex numbers as ids", name);
  }
  return {};
}

bool VertexNumbers::refers_to_accessors(NodeId extension) const {
  bool found = false;
  data_.graph.each_use_in(extension, [&](const graph::Use& use) {
    found |= data_.graph.tree().parent(use.target) == accessors_;
  });
  return found;
}

}  // namespace gltfx::steps
