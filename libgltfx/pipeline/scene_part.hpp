// SPDX-License-Identifier: Apache-2.0
/// One asset of those that a scene is made of, read and posed: the asset that is drawn, or one of
/// its external assets (glTF 2.1).
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "model/draco.hpp"
#include "model/external_places.hpp"
#include "model/geometry.hpp"
#include "model/opened_asset.hpp"
#include "model/resource_data.hpp"
#include "pipeline/scene_builder.hpp"
#include "pipeline/scene_materials.hpp"
#include "schema/set.hpp"

namespace gltfx {

/// What is drawn of an asset, by its own indices; see SceneOptions.
struct PartChoice {
  model::SceneRoots roots;
  std::optional<std::uint32_t> animation, variant;
  bool environment = false;  ///< of the scene
};

/// Stays where it is. The opened asset must outlive it.
struct ScenePart {
  ScenePart(const model::OpenedAsset& opened_asset, PartChoice part_choice,
            const SceneOptions& options, const schema::Set& schemas);
  ScenePart(const ScenePart&) = delete;
  ScenePart& operator=(const ScenePart&) = delete;

  model::GeometrySource geometry() const { return {asset, views, resources, draco}; }
  SceneSource source() { return {asset, resources, animated, notes}; }
  /// Each primitive shows one, or the default material; variants only choose among them.
  std::size_t most_materials() const;

  const model::OpenedAsset& opened;
  const PartChoice choice;
  const model::Asset asset;
  const model::Views& views;
  SceneNotes notes;
  model::ResourceData resources;
  model::AnimatedValues animated;
  model::Pose pose;
  model::DracoMeshes draco;
  std::vector<model::NodeIndex> drawn;       ///< in the scene, with a mesh, a light or a camera
  std::vector<model::ExternalPlace> places;  ///< visible ones
};

}  // namespace gltfx
