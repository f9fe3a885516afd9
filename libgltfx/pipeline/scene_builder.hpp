// SPDX-License-Identifier: Apache-2.0
/// From an opened asset to what the renderer draws: one scene at one moment.
#pragma once

#include <cstdint>
#include <optional>

#include "bake/scene.hpp"
#include "container/container.hpp"
#include "container/resolver.hpp"
#include "json/document.hpp"
#include "schema/set.hpp"

namespace gltfx {

/// What is to be drawn. Numbers beyond the asset's own count as absent.
struct SceneOptions {
  std::optional<std::uint32_t> scene;      ///< else the default scene
  std::optional<std::uint32_t> animation;  ///< else everything as it is written
  double time = 0;                         ///< of the animation, in seconds
  std::optional<std::uint32_t> variant;    ///< of materials
  unsigned jobs = 0;                       ///< threads; 0: as many as are worth it
  /// Most bytes of vertices, and of pixels, beside those that the bytes of the asset are worth.
  std::uint64_t free_bytes = std::uint64_t{1} << 30U;
};

/// Reads, decodes and poses what is visible. The document is that of the container, and should have
/// been validated: what is at fault is left out, and named in the notes of the scene, as is all
/// else that is not drawn. Nothing outside of the resolver's root is opened; images and Draco
/// bitstreams are decoded by worker processes. Keeps no reference.
bake::Scene build_scene(const container::Container& container, const container::Resolver& resolver,
                        const json::Document& document, const schema::Set& schemas,
                        const SceneOptions& options);

}  // namespace gltfx
