// SPDX-License-Identifier: Apache-2.0
/// The asset that is measured, and what several measures need of it, each made once.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "container/container.hpp"
#include "container/opened_files.hpp"
#include "graph/graph.hpp"
#include "measure/byte_count.hpp"
#include "model/asset.hpp"
#include "model/draco.hpp"
#include "model/geometry.hpp"
#include "model/pose.hpp"
#include "model/resource_data.hpp"
#include "model/scene_graph.hpp"
#include "model/views.hpp"
#include "schema/set.hpp"

namespace gltfx::measure {

/// The asset, opened. Keeps references only.
struct Opened {
  const std::string& name;  ///< the path as the user gave it
  const container::Container& container;
  container::OpenedFiles& files;
  const model::Asset& asset;
  const model::Views& views;
  const model::ResourceData& resources;
  const schema::Set& schemas;
  unsigned jobs = 1;  ///< threads for bitstreams
};

/// The nodes of a scene, each once, in the order in which they are reached.
struct SceneNodes {
  std::vector<model::NodeIndex> all;
  std::vector<std::uint32_t> depths;  ///< as `all`; a root has 1
  /// Visible nodes with a mesh, without lower levels of detail.
  std::vector<model::NodeIndex> drawn;
};

/// Not thread-safe: parts are made when they are first asked for.
class Source {
 public:
  explicit Source(const Opened& opened) : opened_(opened) {}
  Source(const Source&) = delete;
  Source& operator=(const Source&) = delete;

  /// The path as the user gave it.
  const std::string& name() const { return opened_.name; }
  const container::Container& container() const { return opened_.container; }
  const json::Document& document() const { return opened_.asset.document(); }
  const model::Asset& asset() const { return opened_.asset; }
  const model::Views& views() const { return opened_.views; }
  const model::ResourceData& resources() const { return opened_.resources; }
  unsigned jobs() const { return opened_.jobs; }

  /// All references, with the texture slots.
  const graph::Graph& graph() const;
  const ByteCount& byte_count() const;
  const model::SceneGraph& scene_graph() const;
  /// The decoded bitstreams.
  const model::DracoMeshes& draco() const;
  /// What PrimitiveData reads; decodes bitstreams.
  const model::GeometrySource& geometry() const;
  /// The transforms of all nodes as they are stored, and what a scene draws. `scene`: index of an
  /// object.
  const model::Pose& pose(std::uint32_t scene) const;
  /// Likewise, the nodes of that scene. Valid until those of another scene are asked for.
  const SceneNodes& nodes_of(std::uint32_t scene) const;
  /// The scene that is drawn by default: `scene`, else the first one; nothing: there is none.
  std::optional<std::uint32_t> default_scene() const;

 private:
  const Opened opened_;
  mutable std::unique_ptr<const graph::Graph> graph_;
  mutable std::optional<const ByteCount> byte_count_;
  mutable std::optional<const model::SceneGraph> scene_graph_;
  mutable std::unique_ptr<const model::DracoMeshes> draco_;
  mutable std::optional<const model::GeometrySource> geometry_;
  mutable std::optional<const model::Pose> pose_;
  mutable std::uint32_t pose_of_ = 0;                            // scene of pose_
  mutable std::optional<const std::vector<bool>> lower_levels_;  // by node
  mutable std::optional<const SceneNodes> scene_nodes_;
  mutable std::uint32_t nodes_of_ = 0;  // scene of scene_nodes_
};

}  // namespace gltfx::measure
