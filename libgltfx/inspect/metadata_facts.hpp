// SPDX-License-Identifier: Apache-2.0
/// The structural metadata of an asset.
#pragma once

#include <gltfx/inspect.hpp>

#include "model/asset.hpp"
#include "model/views.hpp"

namespace gltfx::inspect {

/// Adds the classes of the schema, if it is in the asset, and property tables. Linear in the
/// document.
void add_metadata_facts(const model::Asset& asset, const model::Views& views, AssetFacts& facts);

}  // namespace gltfx::inspect
