// SPDX-License-Identifier: Apache-2.0
#include "model/skin.hpp"

#include <algorithm>

#include "model/fields.hpp"
#include "model/mesh.hpp"

namespace gltfx::model {
namespace {

// Sets of one kind that are numbered 0, 1, 2, ... without gaps; 0 when they are not.
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

bool names_joints(const Asset& asset, json::NodeId primitive) {
  const json::NodeId attributes = object_member(asset.document(), primitive, "attributes");
  if (attributes == json::kNoNode) return false;
  for (const auto member : asset.document().members(attributes)) {
    if (asset.document().key(member.key_id).starts_with("JOINTS")) return true;
  }
  return false;
}

Deformation read_deformation(const Asset& asset, json::NodeId mesh) {
  Deformation deformation;
  const auto all = primitives(asset.document(), mesh);
  if (all.empty() || std::find(all.begin(), all.end(), json::kNoNode) != all.end()) {
    return deformation;
  }
  deformation.known = true;
  deformation.morph_targets = morph_targets(asset.document(), all.front()).size();
  for (const json::NodeId primitive : all) {
    if (!names_joints(asset, primitive)) continue;
    deformation.names_joints = true;
    deformation.has_joints = deformation.has_joints || joint_sets(asset, primitive) != 0;
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

std::size_t joint_sets(const Asset& asset, json::NodeId primitive) {
  const auto attributes =
      read_attributes(asset, object_member(asset.document(), primitive, "attributes"));
  const std::size_t joints = continuous_sets(attributes, SemanticKind::joints);
  return joints == continuous_sets(attributes, SemanticKind::weights) ? joints : 0;
}

std::vector<Deformation> read_deformations(const Asset& asset) {
  std::vector<Deformation> all;
  all.reserve(asset.count(RootArray::meshes));
  for (const json::NodeId mesh : asset.elements(RootArray::meshes)) {
    all.push_back(read_deformation(asset, mesh));
  }
  return all;
}

}  // namespace gltfx::model
