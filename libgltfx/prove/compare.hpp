// SPDX-License-Identifier: Apache-2.0
/// What changed between two opened assets.
#pragma once

#include <gltfx/compare.hpp>

#include <vector>

#include "model/opened_asset.hpp"
#include "prove/change_places.hpp"
#include "schema/set.hpp"

namespace gltfx::prove {

/// Sets all of the report except paths, error and pictures. Returns the boxes of changed objects
/// for pictures, if the options want these. Preconditions: both have a root object.
std::vector<ChangedBoxes> compare_assets(const model::OpenedAsset& ours,
                                         const model::OpenedAsset& theirs,
                                         const schema::Set& schemas, const CompareOptions& options,
                                         CompareReport& report);

}  // namespace gltfx::prove
