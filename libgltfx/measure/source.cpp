// SPDX-License-Identifier: Apache-2.0
#include "measure/source.hpp"

#include "codec/client.hpp"
#include "model/fields.hpp"

namespace gltfx::measure {

const graph::Graph& Source::graph() const {
  if (!graph_) graph_ = std::make_unique<const graph::Graph>(document(), schemas_, true);
  return *graph_;
}

const ByteCount& Source::byte_count() const {
  if (!byte_count_) {
    byte_count_.emplace(count_bytes(container_, files_, asset_, views_, resources_, graph()));
  }
  return *byte_count_;
}

const model::SceneGraph& Source::scene_graph() const {
  if (!scene_graph_) scene_graph_.emplace(asset_, views_.nodes);
  return *scene_graph_;
}

const model::DracoMeshes& Source::draco() const {
  if (!draco_) {
    auto meshes = std::make_unique<model::DracoMeshes>();
    meshes->add_all(asset_, views_, resources_);
    meshes->decode(codec::Client::shared(), jobs_);
    draco_ = std::move(meshes);
  }
  return *draco_;
}

const model::GeometrySource& Source::geometry() const {
  if (!geometry_) {
    geometry_.emplace(model::GeometrySource{asset_, views_, resources_, draco()});
  }
  return *geometry_;
}

const model::Pose& Source::pose(std::uint32_t scene) const {
  if (!pose_ || pose_of_ != scene) {
    pose_.emplace(model::compute_pose(asset_, views_, model::choose_scene(asset_, views_, scene)));
    pose_of_ = scene;
  }
  return *pose_;
}

std::optional<std::uint32_t> Source::default_scene() const {
  return model::choose_scene(asset_, views_).scene;
}

}  // namespace gltfx::measure
