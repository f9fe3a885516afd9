// SPDX-License-Identifier: Apache-2.0
/// Compares meshes as surfaces: by material, in any order of primitives and triangles.
#pragma once

#include <optional>
#include <vector>

#include "prove/changes.hpp"
#include "prove/soup_pair.hpp"

namespace gltfx::prove {

/// A primitive at its place.
struct SurfacePiece {
  const Content* content = nullptr;
  json::NodeId primitive = json::kNoNode;
  std::optional<std::uint32_t> material;
  model::Affine place;
  const std::vector<double>* joints = nullptr;  ///< the numbers of joints; null: as stored
  const Surface* known = nullptr;  ///< what is known of it in its own space; may be null
  std::optional<model::Affine> turn = std::nullopt;  ///< of normals and tangents; nothing: `place`
};

/// Two surfaces to compare.
struct SurfacePair {
  std::vector<SurfacePiece> ours, theirs;
  double scale = 1;       ///< from the space of the places to that of the scene
  std::string name;       ///< of the mesh
  std::string our_place;  ///< pointer to the mesh, or to a primitive
  std::string their_place;
};

/// The changes between them; empty: they show the same. `unread`: pieces that cannot be read.
struct SurfaceChanges {
  std::vector<Change> changes;
  bool unread = false;

  CompareLevel level() const {
    CompareLevel level = CompareLevel::storage;
    for (const Change& change : changes) level = std::max(level, change.level);
    return level;
  }
  /// Whether all vertices are where the other surface has them, within bounds.
  bool same_places() const;
};
SurfaceChanges compare_surfaces(const Comparison& comparison, const SurfacePair& pair);

}  // namespace gltfx::prove
