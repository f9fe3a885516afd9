// SPDX-License-Identifier: Apache-2.0
#include "measure/drawn.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/checked.hpp"
#include "model/fields.hpp"
#include "model/instancing.hpp"

namespace gltfx::measure {
namespace {

class SceneWalk {
 public:
  SceneWalk(const Source& source, std::uint32_t scene, const std::vector<bool>& lower)
      : source_(source),
        pose_(source.pose(scene)),
        lower_(lower),
        reached_(source.views().nodes.size()) {
    for (const model::NodeIndex root :
         model::choose_scene(source.asset(), source.views(), scene).nodes) {
      enter(root, 1, true);
    }
  }

  SceneNodes run() {
    for (std::size_t next = 0; next < nodes_.all.size(); ++next) {
      const model::NodeIndex node = nodes_.all[next];
      const bool drawn = drawn_[next];
      const std::uint32_t depth = nodes_.depths[next];
      model::for_each_index(source_.asset(), source_.views().nodes[node].children,
                            model::RootArray::nodes,
                            [&](std::uint64_t, const auto& child, const Span&) {
                              if (child) enter(*child, depth + 1, drawn);
                            });
    }
    return std::move(nodes_);
  }

 private:
  void enter(model::NodeIndex node, std::uint32_t depth, bool drawn) {
    if (reached_[node]) return;
    reached_[node] = true;
    drawn = drawn && !lower_[node] && pose_.visible[node] != 0;
    nodes_.all.push_back(node);
    nodes_.depths.push_back(depth);
    drawn_.push_back(drawn);
    if (drawn && source_.views().nodes[node].mesh) nodes_.drawn.push_back(node);
  }

  const Source& source_;
  const model::Pose& pose_;
  const std::vector<bool>& lower_;
  std::vector<bool> reached_;
  SceneNodes nodes_;
  std::vector<bool> drawn_;  // as nodes_.all
};

}  // namespace

std::vector<bool> lower_levels(const Source& source) {
  const model::Asset& asset = source.asset();
  std::vector<bool> lower(source.views().nodes.size());
  for (const model::Node& node : source.views().nodes) {
    if (node.extensions == json::kNoNode) continue;
    const json::NodeId lod = model::extension_object(source.document(), node.object, "MSFT_lod");
    if (lod == json::kNoNode) continue;
    model::for_each_index(asset, source.document().find(lod, "ids"), model::RootArray::nodes,
                          [&](std::uint64_t, const auto& index, const Span&) {
                            if (index) lower[*index] = true;
                          });
  }
  return lower;
}

SceneNodes find_nodes(const Source& source, std::uint32_t scene, const std::vector<bool>& lower) {
  return SceneWalk(source, scene, lower).run();
}

bool is_affordable(const Source& source, std::uint32_t scene) {
  constexpr std::uint64_t kFewObjects = 1'000'000, kScenesPerObject = 16;
  const std::uint64_t objects = source.views().nodes.size() + source.views().meshes.size() +
                                source.asset().count(model::RootArray::materials);
  return scene < kScenesPerObject || scene * objects <= kFewObjects + kScenesPerObject * objects;
}

bool is_finite(const Linear& linear) {
  return std::all_of(linear.begin(), linear.end(), [](const model::Vector3& column) {
    return std::all_of(column.begin(), column.end(),
                       [](double each) { return std::isfinite(each); });
  });
}

std::optional<double> common_factor(const Linear& linear) {
  constexpr double kUnequal = 1e-12;
  const auto& [x, y, z] = linear;
  const double square = model::dot(x, x);
  for (const double difference : {model::dot(y, y) - square, model::dot(z, z) - square,
                                  model::dot(x, y), model::dot(y, z), model::dot(z, x)}) {
    if (!(std::abs(difference) <= kUnequal * square)) return std::nullopt;
  }
  return square;
}

void DrawnMeshes::enter(std::uint32_t scene) {
  by_mesh_.clear();
  joint_matrices_.clear();
  scene_ = scene;
  for (const model::NodeIndex node : source_.nodes_of(scene).drawn) {
    by_mesh_[*source_.views().nodes[node].mesh].push_back(node);
  }
}

// As many as the mesh has targets.
bool DrawnMeshes::has_own_weights(model::NodeIndex index) const {
  const model::Node& node = source_.views().nodes[index];
  const auto& primitives = source_.views().meshes[*node.mesh].primitives;
  const json::NodeId weights = source_.document().find(node.object, "weights");
  return weights != json::kNoNode && source_.document().is_array(weights) && !primitives.empty() &&
         source_.document().array_size(weights) == primitives.front().targets.size();
}

std::optional<std::vector<float>> DrawnMeshes::weights_of(model::NodeIndex node) {
  const std::uint32_t mesh = *source_.views().nodes[node].mesh;
  const auto& primitives = source_.views().meshes[mesh].primitives;
  const std::uint64_t targets = primitives.empty() ? 0 : primitives.front().targets.size();
  if (targets == 0) return std::vector<float>();
  const bool own = has_own_weights(node);
  const auto known = mesh_weights_.find(mesh);
  const bool still = !own && known != mesh_weights_.end() && known->second.empty();
  if (still) return std::vector<float>();
  if (!budget_.take(checked_mul(targets, sizeof(float)))) return std::nullopt;
  if (!own && known != mesh_weights_.end()) return known->second;
  std::vector<float> weights = model::morph_weights(source_.asset(), source_.views(), node);
  const bool moves =
      std::any_of(weights.begin(), weights.end(), [](float weight) { return weight != 0; });
  if (!moves) weights.clear();
  if (!own) mesh_weights_.emplace(mesh, weights);
  return weights;
}

std::optional<std::span<const model::Affine>> DrawnMeshes::joints_of(std::uint32_t skin) {
  const auto known = joint_matrices_.find(skin);
  if (known != joint_matrices_.end()) return known->second;
  const json::NodeId object = source_.asset().elements(model::RootArray::skins)[skin];
  const json::NodeId joints = source_.document().find(object, "joints");
  const bool listed = joints != json::kNoNode && source_.document().is_array(joints);
  const std::uint64_t count = listed ? source_.document().array_size(joints) : 0;
  if (!budget_.take(checked_mul(count, sizeof(model::Affine)))) return std::nullopt;
  auto matrices = model::joint_matrices(source_.asset(), source_.views(), source_.resources(), skin,
                                        source_.pose(scene_));
  return joint_matrices_.emplace(skin, std::move(matrices)).first->second;
}

std::optional<MeshPose> DrawnMeshes::pose_of(model::NodeIndex node) {
  const auto& skin = source_.views().nodes[node].skin;
  auto weights = weights_of(node);
  const auto joints = skin ? joints_of(*skin) : std::optional(std::span<const model::Affine>());
  if (!weights || !joints) {
    why_ = kTooMuchDrawn;
    return std::nullopt;
  }
  return MeshPose{*std::move(weights), *joints};
}

// Skins move vertices to the space of the scene.
std::vector<model::Affine> DrawnMeshes::transforms_of(model::NodeIndex node, const MeshPose& pose) {
  why_ = {};
  const model::Affine world =
      pose.joints.empty() ? source_.pose(scene_).world[node] : model::Affine();
  auto copies = model::read_instancing(source_.asset(), source_.views(), source_.resources(),
                                       source_.views().nodes[node], budget_);
  if (!copies) return {world};
  if (!copies->readable) why_ = copies->too_large ? kTooMuchDrawn : kUnreadCopies;
  for (model::Affine& copy : copies->transforms) copy = world * copy;
  return std::move(copies->transforms);
}

}  // namespace gltfx::measure
