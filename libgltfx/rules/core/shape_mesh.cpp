// SPDX-License-Identifier: Apache-2.0
// Meshes of shapes, and the places of bounding volumes of skinned meshes (glTF 2.1).
#include <set>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "base/codes.hpp"
#include "base/text.hpp"
#include "model/shape.hpp"
#include "model/skin.hpp"
#include "rules/finding.hpp"

namespace gltfx::validate {
namespace {

using model::NodeIndex;
using model::RootArray;

// What is wrong with a mesh as a shape, as the end of a sentence; empty: nothing.
std::string fault_of_shape_mesh(const model::Mesh& mesh) {
  if (mesh.primitives.size() != 1) {
    return fmt::format("has {} primitives; it must have one", mesh.primitives.size());
  }
  const model::Primitive& primitive = mesh.primitives.front();
  if (primitive.node == json::kNoNode || !primitive.mode) return {};  // reported elsewhere
  if (!model::draws_triangles(*primitive.mode)) {
    return fmt::format("has the mode {}; it must have triangles",
                       model::mode_name(*primitive.mode));
  }
  if (primitive.find(model::SemanticKind::position) == nullptr) {
    return "has no attribute POSITION";
  }
  return {};
}

void check_meshes_of_shapes(const Context& context) {
  if (context.version <= schema::kVersion2) return;
  const std::vector<model::ShapeObject> shapes = model::read_shapes(context.asset);
  for (std::size_t i = 0; i < shapes.size(); ++i) {
    const model::ShapeObject& shape = shapes[i];
    if (!shape.mesh) continue;
    const std::string fault = fault_of_shape_mesh(context.views.meshes[*shape.mesh]);
    if (fault.empty()) continue;
    report_at(
        context.link_sink, fmt::format("/shapes/{}/{}/mesh", i, shape.type),
        finding_on(context, shape.mesh_value, Code::SHAPE_MESH_INVALID,
                   fmt::format("The shape is made of {}, which {}.",
                               object_label(context, RootArray::meshes, *shape.mesh), fault)));
  }
}

// The parents of nodes that move with a skinned mesh: those of the roots among its joints, these
// roots, and the root of its skeleton. kNoNodeIndex: a root of the scene.
std::set<NodeIndex> parents_beside_skin(const Context& context, const model::Skin& skin) {
  const std::set<NodeIndex> joints(skin.joint_nodes.begin(), skin.joint_nodes.end());
  std::set<NodeIndex> parents;
  if (skin.skeleton) parents.insert(*skin.skeleton);
  for (const NodeIndex joint : joints) {
    const NodeIndex above = context.graph.parent(joint);
    if (joints.count(above) == 0) parents.insert({above, joint});
  }
  return parents;
}

void check_skinned_volumes(const Context& context) {
  if (context.version <= schema::kVersion2) return;
  const auto& skins = context.asset.elements(RootArray::skins);
  if (skins.empty()) return;
  const auto volumes = model::read_bounding_volumes(context.asset, context.views.nodes);
  std::vector<std::set<NodeIndex>> parents(skins.size());
  for (NodeIndex i = 0; i < volumes.size(); ++i) {
    const model::Node& node = context.views.nodes[i];
    if (!volumes[i] || !node.mesh || !node.skin) continue;
    std::set<NodeIndex>& known = parents[*node.skin];
    if (known.empty()) {
      known = parents_beside_skin(context, model::read_skin(context.asset, skins[*node.skin]));
    }
    if (known.empty() || known.count(context.graph.parent(i)) > 0) continue;
    report_at(context.link_sink, fmt::format("/nodes/{}/boundingVolume", i),
              finding_on(context, volumes[i]->object, Code::BOUNDING_VOLUME_SKIN_PLACE,
                         fmt::format("{} moves its volume by other transforms than {} moves its "
                                     "mesh: it is neither a child of the root of the skeleton nor "
                                     "a sibling of a root of the joints.",
                                     capitalized(object_label(context, RootArray::nodes, i)),
                                     object_label(context, RootArray::skins, *node.skin))));
  }
}

}  // namespace

const RuleGroup& shape_mesh_rules() {
  static constexpr LinkRule kLinkRules[] = {check_meshes_of_shapes, check_skinned_volumes};
  static constexpr RuleGroup group{.additional = true, .link_rules = kLinkRules};
  return group;
}

}  // namespace gltfx::validate
