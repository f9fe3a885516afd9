// SPDX-License-Identifier: Apache-2.0
/// What changed between two opened assets.
#pragma once

#include <gltfx/compare.hpp>

#include "model/opened_asset.hpp"
#include "schema/set.hpp"

namespace gltfx::prove {

/// Sets all of the report except paths and error. Preconditions: both have a root object.
void compare_assets(const model::OpenedAsset& ours, const model::OpenedAsset& theirs,
                    const schema::Set& schemas, const CompareOptions& options,
                    CompareReport& report);

}  // namespace gltfx::prove
