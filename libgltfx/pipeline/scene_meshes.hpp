// SPDX-License-Identifier: Apache-2.0
/// Meshes of an asset as those of a scene, each pose of each once.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <tuple>
#include <unordered_map>
#include <vector>

#include "model/geometry.hpp"
#include "model/pose.hpp"
#include "pipeline/geometry_key.hpp"
#include "pipeline/scene_materials.hpp"
#include "render/scene.hpp"

namespace gltfx {

/// Primitives that are drawn together.
struct DrawnMeshes {
  std::uint32_t mesh = 0;   ///< index of the first in the scene
  std::uint32_t count = 0;  ///< of those that follow each other there
  bool skinned = false;     ///< stand where they are to be drawn, wherever their node is
  model::Vector3 origin{};  ///< of their positions, which is not 0 if they are far from it
};

/// The moment that is drawn. All references must outlive it.
struct DrawnMoment {
  const model::Pose& pose;
  const model::AnimatedValues& animated;
  model::Vector3 origin{};  ///< what is to be at 0 in the scene
};

/// All references must outlive it.
class SceneMeshes {
 public:
  SceneMeshes(const model::GeometrySource& source, const DrawnMoment& moment,
              std::optional<std::uint32_t> variant, SceneMaterials& materials,
              model::MemoryBudget& budget, SceneNotes& notes, render::Scene& scene)
      : source_(source),
        moment_(moment),
        variant_(variant),
        materials_(materials),
        budget_(budget),
        notes_(notes),
        scene_(scene),
        kept_(source.views) {}

  /// The primitives of the mesh of a node at the node's pose; none when there is no memory left for
  /// another pose. The node has a mesh.
  const std::vector<DrawnMeshes>& use(model::NodeIndex node);
  /// Those of a mesh that no node refers to.
  const std::vector<DrawnMeshes>& use_mesh(std::uint32_t mesh);

 private:
  /// Mesh, skin or kNone, weights of morph targets unless all are 0.
  using Key = std::tuple<std::uint32_t, std::uint32_t, std::vector<float>>;
  /// Mesh, skin or kNone.
  using PlainKey = std::pair<std::uint32_t, std::uint32_t>;
  /// What markers are drawn for.
  struct Marked {
    std::vector<model::Segment> segments;
    std::vector<std::uint32_t> points;
  };

  bool has_own_weights(model::NodeIndex node) const;
  const std::vector<DrawnMeshes>& use(Key key);
  const std::vector<model::Affine>& joints(std::uint32_t skin);
  void draw(const Key& key, const std::vector<bool>& bound, bool moved,
            std::vector<DrawnMeshes>& drawn);
  /// The origin of what was added to the scene, if anything was.
  std::optional<model::Vector3> draw(const Key& key, std::uint32_t index, bool moved);
  std::optional<model::Vector3> draw_new(const Key& key, std::uint32_t index, bool moved,
                                         const MaterialNeeds& needs);
  bool add_markers(const Key& key, std::uint32_t index, const Marked& marked, render::Mesh& drawn);
  void add_tangents(const MaterialNeeds& needs, model::Geometry& geometry);

  const model::GeometrySource& source_;
  const DrawnMoment moment_;
  std::optional<std::uint32_t> variant_;
  SceneMaterials& materials_;
  model::MemoryBudget& budget_;
  SceneNotes& notes_;
  render::Scene& scene_;
  KeptGeometry kept_;
  const std::vector<DrawnMeshes> nothing_;
  std::map<Key, std::vector<DrawnMeshes>> known_;
  std::map<PlainKey, const std::vector<DrawnMeshes>*> usual_;  ///< of nodes without own weights
  std::unordered_map<std::uint32_t, std::vector<model::Affine>> joints_;
};

}  // namespace gltfx
