// SPDX-License-Identifier: Apache-2.0
/// Compares pieces of surfaces that have one material.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "prove/compare_surfaces.hpp"

namespace gltfx::prove {

/// A change of a pair of surfaces.
Change change_of(const SurfacePair& pair, std::string_view kind, std::string what);

/// What is known of the pieces.
struct SoupGroup {
  const SurfacePair& pair;
  const TextureUse& use;               ///< of the material
  const SurfacePiece* ours = nullptr;  ///< the first one; null: there is none
  const SurfacePiece* theirs = nullptr;
  bool lone = false;  ///< there is one of each
};

/// Adds the changes between soups of one arity, which it takes. Precondition: not all of the pieces
/// are equal.
void compare_soup_lists(const Comparison& comparison, const SoupGroup& group,
                        std::vector<Soup>&& ours, std::vector<Soup>&& theirs,
                        std::vector<Change>& changes);

}  // namespace gltfx::prove
