// SPDX-License-Identifier: Apache-2.0
// Moves the roots of the default scene so that its box is at the origin.
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "codec/client.hpp"
#include "model/external_places.hpp"
#include "model/fields.hpp"
#include "model/scene_box.hpp"
#include "model/scene_graph.hpp"
#include "model/skin.hpp"
#include "steps/node_moves.hpp"

namespace gltfx::steps {
namespace {

// Part of the diagonal: what rounding leaves is not moved again.
constexpr double kAtOrigin = 1e-7;

class Centerer {
 public:
  explicit Centerer(const StepInput& input)
      : data_(input),
        changes_(data_),
        roots_(model::choose_scene(data_.asset, data_.views)),
        pose_(model::compute_pose(data_.asset, data_.views, roots_)) {}

  Result<StepOutcome> run() {
    model::DracoMeshes draco;
    draco.add_all(data_.asset, data_.views, data_.resources);
    draco.decode(codec::Client::shared(), data_.input.options.jobs);
    const auto box = model::scene_box({data_.asset, data_.views, data_.resources, draco}, pose_);
    if (!box) return Error{fmt::format("the default scene {}", box.error().message)};
    if (box->empty()) {
      outcome_.row.left.push_back({"", "the default scene draws nothing"});
      return std::move(outcome_);
    }
    model::Vector3 shift = box->center();
    for (double& each : shift) each = 0 - each;
    if (data_.input.options.placement.center == Pivot::bottom) shift[1] = 0 - box->least[1];
    if (std::sqrt(model::dot(shift, shift)) <= kAtOrigin * box->diagonal())
      return std::move(outcome_);
    outcome_.row.refused = find_obstacles();
    if (outcome_.row.refused.empty()) outcome_.row.refused = move(shift);
    if (!outcome_.row.refused.empty()) return std::move(outcome_);
    auto change = changes_.finish();
    if (!change) return change.error();
    outcome_.change = *std::move(change);
    outcome_.freedom.own_proof = true;
    outcome_.row.what =
        fmt::format("moved by {:.6g}, {:.6g}, {:.6g}", shift[0], shift[1], shift[2]);
    return std::move(outcome_);
  }

 private:
  std::vector<ConvertNote> move(const model::Vector3& shift) {
    NodeMoves moves;
    for (const model::NodeIndex node : roots_.nodes) moves[node] = {1, shift, false};
    return move_nodes(data_, moves, changes_);
  }

  // What is placed in the scene, but not by its roots.
  std::vector<ConvertNote> find_obstacles() const {
    std::vector<ConvertNote> found;
    const schema::Set& set = data_.graph.set();
    const json::NodeId extensions =
        model::object_member(data_.document, data_.document.root(), "extensions");
    for (json::NodeId id = 0; id < data_.document.node_count(); ++id) {
      const json::NodeId owner = data_.graph.tree().parent(id);
      const bool is_of_root = owner != json::kNoNode && owner == extensions;
      if (!is_of_root || data_.graph.type(id) == schema::kNone) continue;
      const auto& type = set.type(set.type(data_.graph.type(id)).origin);
      for (const schema::Property& property : type.properties) {
        const json::NodeId value = data_.document.find(id, property.name);
        if (property.unit != "m" || value == json::kNoNode || !data_.document.is_array(value))
          continue;
        found.push_back({data_.pointer(value), "is a place that does not follow the nodes"});
      }
    }
    const model::SceneGraph graph(data_.asset, data_.views.nodes);
    for (const model::NodeIndex root : roots_.nodes) {
      if (!graph.is_root(root))
        found.push_back({data_.pointer(data_.views.nodes[root].object),
                         "is a root of the scene and a child of another node"});
    }
    for (const auto& place : model::external_places(data_.document, data_.views)) {
      if (pose_.visible[place.node] == 0) continue;
      found.push_back({data_.pointer(data_.views.nodes[place.node].object),
                       "has an external asset, which is not part of the box"});
    }
    add_joints(found);
    return found;
  }

  // A skinned mesh in the scene with joints outside of it would not follow.
  void add_joints(std::vector<ConvertNote>& found) const {
    const auto& skins = data_.asset.elements(model::RootArray::skins);
    std::vector<bool> looked_at(skins.size(), false);
    for (std::size_t i = 0; i < data_.views.nodes.size(); ++i) {
      const auto& skin = data_.views.nodes[i].skin;
      if (pose_.in_scene[i] == 0 || !skin || looked_at[*skin]) continue;
      looked_at[*skin] = true;
      for (const model::NodeIndex joint : model::read_skin(data_.asset, skins[*skin]).joint_nodes) {
        if (pose_.in_scene[joint] != 0) continue;
        found.push_back(
            {data_.pointer(data_.views.nodes[i].object), "has joints outside of the scene"});
        break;
      }
    }
  }

  const StepData data_;
  StepChanges changes_;
  const model::SceneRoots roots_;
  const model::Pose pose_;
  StepOutcome outcome_;
};

}  // namespace

StepDescription center_step();
StepDescription center_step() {
  return {"center",
          "moves the default scene to the origin: the bottom or the center of its box at rest",
          "meshes and their data, sizes, and directions",
          "nothing beyond rounding of changed numbers",
          [](const ConvertOptions& options) { return options.placement.center.has_value(); },
          [](const StepInput& input) { return Centerer(input).run(); }};
}

}  // namespace gltfx::steps
