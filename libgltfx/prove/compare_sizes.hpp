// SPDX-License-Identifier: Apache-2.0
/// What the bytes of the files of two assets are used for.
#pragma once

#include <gltfx/compare.hpp>

#include "prove/changes.hpp"

namespace gltfx::prove {

/// The sizes of all files, and of each use of bytes that differs. Notes extensions for storage that
/// only one of the assets uses. Takes time n log n.
std::vector<CompareSize> compare_sizes(const Comparison& comparison, const model::OpenedAsset& ours,
                                       const model::OpenedAsset& theirs);

}  // namespace gltfx::prove
