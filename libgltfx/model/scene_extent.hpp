// SPDX-License-Identifier: Apache-2.0
/// What the default scene shows, by what accessors say of themselves: no vertex is read.
#pragma once

#include <gltfx/inspect.hpp>

#include <cstdint>
#include <optional>
#include <span>

#include "model/resource_data.hpp"
#include "model/views.hpp"

namespace gltfx::model {

struct SceneExtent {
  std::optional<SceneBounds> bounds;
  NodeIndex farthest = 0;       ///< with bounds: the node that reaches farthest from the origin
  std::uint64_t triangles = 0;  ///< each time a node draws them
};

/// `meshes`: by index, with their triangles; empty: none are counted. `instance_bytes`: what the
/// transforms of instances may take; the node stands for those that do not fit. Bounds are those of
/// the corners of each mesh's own bounds, so that of turned meshes they may be too wide. Takes time
/// linear in nodes and instances, and in the joints of skinned meshes up to a limit, beyond which
/// one joint stands for all.
SceneExtent scene_extent(const Asset& asset, const Views& views, const ResourceData& resources,
                         std::span<const MeshFacts> meshes, std::uint64_t instance_bytes);

}  // namespace gltfx::model
