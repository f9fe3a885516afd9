// SPDX-License-Identifier: Apache-2.0
#include "model/skin.hpp"

#include <algorithm>

namespace gltfx::model {
namespace {

// Number of sets of one kind if they are numbered 0, 1, 2, ... without gaps; else 0.
std::size_t continuous_sets(const std::vector<Attribute>& attributes, SemanticKind kind) {
  std::size_t count = 0;
  std::uint64_t greatest = 0;
  for (const Attribute& attribute : attributes) {
    if (attribute.semantic.kind != kind) continue;
    ++count;
    greatest = std::max(greatest, attribute.semantic.set);
  }
  return count != 0 && greatest == count - 1 ? count : 0;
}

bool names_joints(const Primitive& primitive) {
  return std::any_of(primitive.attributes.begin(), primitive.attributes.end(),
                     [](const Attribute& each) { return each.name.starts_with("JOINTS"); });
}

Deformation read_deformation(const Mesh& mesh, bool some_may_lack_targets) {
  Deformation deformation;
  if (mesh.primitives.empty() || mesh.has_holes) return deformation;
  deformation.known = true;
  const Primitive* decides = &mesh.primitives.front();
  for (const Primitive& primitive : mesh.primitives) {
    if (!some_may_lack_targets || !decides->targets.empty()) break;
    if (!primitive.targets.empty()) decides = &primitive;
  }
  deformation.morph_targets = decides->targets.size();
  deformation.targets_are_broken = decides->targets_are_broken;
  for (const Primitive& primitive : mesh.primitives) {
    if (!names_joints(primitive)) {
      deformation.has_rigid = true;
      continue;
    }
    deformation.names_joints = true;
    deformation.has_joints = deformation.has_joints || joint_sets(primitive) != 0;
  }
  return deformation;
}

}  // namespace

Skin read_skin(const Asset& asset, json::NodeId object) {
  const json::Document& document = asset.document();
  Skin skin;
  skin.object = object;
  skin.inverse_bind_matrices_value = document.find(object, "inverseBindMatrices");
  skin.inverse_bind_matrices = asset.index(object, "inverseBindMatrices", RootArray::accessors);
  skin.skeleton_value = document.find(object, "skeleton");
  skin.skeleton = asset.index(object, "skeleton", RootArray::nodes);
  const json::NodeId joints = document.find(object, "joints");
  if (joints == json::kNoNode || !document.is_array(joints)) return skin;
  skin.joints = joints;
  for_each_index(asset, joints, RootArray::nodes,
                 [&](std::uint64_t, std::optional<std::uint32_t> joint, Span) {
                   ++skin.joint_count;
                   if (joint) skin.joint_nodes.push_back(*joint);
                 });
  return skin;
}

std::span<const NodeIndex> joints_of_last_root(const std::vector<NodeIndex>& joints,
                                               const SceneGraph& graph) {
  std::size_t first = 0;
  for (std::size_t i = 0; i < joints.size(); ++i) {
    const bool apart = i > first && graph.component(joints[i]) != graph.component(joints[first]);
    if (apart) first = i + 1;
  }
  return std::span(joints).subspan(std::min(first, joints.size()));
}

std::size_t joint_sets(const Primitive& primitive) {
  const std::size_t joints = continuous_sets(primitive.attributes, SemanticKind::joints);
  const std::size_t weights = continuous_sets(primitive.attributes, SemanticKind::weights);
  return joints == weights ? joints : 0;
}

std::vector<Deformation> read_deformations(const std::vector<Mesh>& meshes,
                                           bool some_may_lack_targets) {
  std::vector<Deformation> all;
  all.reserve(meshes.size());
  for (const Mesh& mesh : meshes) all.push_back(read_deformation(mesh, some_may_lack_targets));
  return all;
}

}  // namespace gltfx::model
