// SPDX-License-Identifier: Apache-2.0
/// Files, external assets and bounding volumes of an asset (glTF 2.1).
#pragma once

#include <gltfx/inspect.hpp>

#include "model/opened_asset.hpp"
#include "schema/set.hpp"

namespace gltfx::inspect {

/// Adds them to the asset's own facts; what it draws and its bounds then include external assets.
/// Opens each external asset once; nothing recurses. An asset before glTF 2.1 has none of them.
void add_external_facts(const model::OpenedAsset& opened, const schema::Set& schemas,
                        const InspectOptions& options, AssetFacts& facts);

}  // namespace gltfx::inspect
