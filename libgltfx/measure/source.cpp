// SPDX-License-Identifier: Apache-2.0
#include "measure/source.hpp"

#include "codec/client.hpp"
#include "measure/drawn.hpp"
#include "model/fields.hpp"

namespace gltfx::measure {

const graph::Graph& Source::graph() const {
  if (!graph_) graph_ = std::make_unique<const graph::Graph>(document(), opened_.schemas, true);
  return *graph_;
}

const ByteCount& Source::byte_count() const {
  if (!byte_count_) {
    byte_count_.emplace(
        count_bytes(container(), opened_.files, asset(), views(), resources(), graph()));
  }
  return *byte_count_;
}

const model::SceneGraph& Source::scene_graph() const {
  if (!scene_graph_) scene_graph_.emplace(asset(), views().nodes);
  return *scene_graph_;
}

const model::DracoMeshes& Source::draco() const {
  if (!draco_) {
    auto meshes = std::make_unique<model::DracoMeshes>();
    meshes->add_all(asset(), views(), resources());
    meshes->decode(codec::Client::shared(), opened_.jobs);
    draco_ = std::move(meshes);
  }
  return *draco_;
}

const model::GeometrySource& Source::geometry() const {
  if (!geometry_) {
    geometry_.emplace(model::GeometrySource{asset(), views(), resources(), draco()});
  }
  return *geometry_;
}

const model::Pose& Source::pose(std::uint32_t scene) const {
  if (!pose_ || pose_of_ != scene) {
    pose_.emplace(
        model::compute_pose(asset(), views(), model::choose_scene(asset(), views(), scene)));
    pose_of_ = scene;
  }
  return *pose_;
}

const SceneNodes& Source::nodes_of(std::uint32_t scene) const {
  if (!lower_levels_) lower_levels_.emplace(lower_levels(*this));
  if (!scene_nodes_ || nodes_of_ != scene) {
    scene_nodes_.emplace(find_nodes(*this, scene, *lower_levels_));
    nodes_of_ = scene;
  }
  return *scene_nodes_;
}

std::optional<std::uint32_t> Source::default_scene() const {
  return model::choose_scene(asset(), views()).scene;
}

}  // namespace gltfx::measure
