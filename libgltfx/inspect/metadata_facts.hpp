// SPDX-License-Identifier: Apache-2.0
/// What structural metadata an asset has.
#pragma once

#include <gltfx/inspect.hpp>

#include "model/asset.hpp"
#include "model/views.hpp"

namespace gltfx::inspect {

/// Classes of the schema, where it stands in the asset, and property tables. Linear in the
/// document.
void add_metadata_facts(const model::Asset& asset, const model::Views& views, AssetFacts& facts);

}  // namespace gltfx::inspect
