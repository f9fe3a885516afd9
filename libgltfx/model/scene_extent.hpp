// SPDX-License-Identifier: Apache-2.0
/// Extent of the default scene, by the bounds of accessors: no vertex is read.
#pragma once

#include <gltfx/inspect.hpp>

#include <cstdint>
#include <optional>
#include <span>

#include "model/pose.hpp"
#include "model/resource_data.hpp"
#include "model/views.hpp"

namespace gltfx::model {

struct SceneExtent {
  std::optional<SceneBounds> bounds;
  NodeIndex farthest = 0;       ///< with bounds: the node that reaches farthest from the origin
  std::uint64_t triangles = 0;  ///< counted for each node that draws them
};

/// `meshes`: by index, with their triangles; empty: none are counted. `instance_bytes`: memory
/// limit for the transforms of instances; the node is used for those that do not fit. `pose`: of
/// the default scene. Bounds come from the corners of each mesh's own bounds, so they may be too
/// wide for rotated meshes. Takes time linear in nodes and instances, and in the joints of skinned
/// meshes up to a limit, beyond which only one joint is used.
SceneExtent scene_extent(const Asset& asset, const Views& views, const ResourceData& resources,
                         std::span<const MeshFacts> meshes, std::uint64_t instance_bytes,
                         const Pose& pose);

/// Extends `bounds` by others after a transform, likewise.
void include_bounds(const SceneBounds& others, const Affine& transform,
                    std::optional<SceneBounds>& bounds);

}  // namespace gltfx::model
