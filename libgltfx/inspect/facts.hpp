// SPDX-License-Identifier: Apache-2.0
/// What is in an asset, whether it is valid or not.
#pragma once

#include <gltfx/inspect.hpp>

#include "model/opened_asset.hpp"
#include "schema/set.hpp"

namespace gltfx::inspect {

/// Pure but for the files that the asset refers to, which are opened and, but for headers of images
/// and compressed geometry, not read. The document has a root object. What is malformed counts as
/// absent, what cannot be read is named in `problems`. Takes time n log n in the text and the bytes
/// of compressed geometry; nothing recurses.
AssetFacts collect_facts(const model::OpenedAsset& opened, const schema::Set& schemas,
                         unsigned jobs);

}  // namespace gltfx::inspect
