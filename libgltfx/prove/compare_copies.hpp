// SPDX-License-Identifier: Apache-2.0
/// Copies of a mesh that a node draws (model/instancing.hpp).
#pragma once

#include <cstdint>
#include <optional>

#include "prove/changes.hpp"

namespace gltfx::prove {

/// The copies of two matched nodes.
struct CopiesPair {
  /// From the mesh of the new asset to that of the old one: what the transforms of all copies have
  /// undone. Nothing: the transforms are equal, or do not differ by one transform.
  std::optional<model::Affine> place;
  double scale = 1;     ///< the greatest one of a copy
  double movement = 0;  ///< of the corners of the mesh: the farthest one, in the space of the node
  std::size_t moved = 0;  ///< copies with another transform
  std::size_t count = 0;
};

/// Nothing unless both nodes draw as many copies and have a mesh, and all transforms can be read.
std::optional<CopiesPair> pair_copies(const Comparison& comparison, std::uint32_t our_node,
                                      std::uint32_t their_node);

/// The transforms of copies are no change: they undo what happened to the mesh.
void forget_copies(const Comparison& comparison, std::uint32_t our_node, std::uint32_t their_node);

/// Tells how far copies moved, in place of their values.
void tell_copies(const Comparison& comparison, std::uint32_t our_node, std::uint32_t their_node,
                 const CopiesPair& copies);

}  // namespace gltfx::prove
