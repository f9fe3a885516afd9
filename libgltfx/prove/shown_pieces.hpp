// SPDX-License-Identifier: Apache-2.0
/// Pieces of surfaces by what they show where they are placed.
#pragma once

#include <vector>

#include "prove/compare_surfaces.hpp"
#include "prove/soup.hpp"

namespace gltfx::prove {

/// A piece with the hash of what it shows where it is placed.
struct ShownPiece {
  const SurfacePiece* piece = nullptr;
  Hash128 sum;
  bool readable = true;
  bool done = false;
};

/// Pieces of both sides with one material.
struct ShownGroup {
  std::vector<ShownPiece*> ours, theirs;

  /// Whether both sides show the same.
  bool equal() const;
};

/// The elements of a piece where it is placed. `with_normals`: with those of planes if it has none.
Soup soup_of(const SurfacePiece& piece, bool with_normals = false);
/// The piece must outlive it.
ShownPiece show_piece(const SurfacePiece& piece);

}  // namespace gltfx::prove
