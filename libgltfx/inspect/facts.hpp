// SPDX-License-Identifier: Apache-2.0
/// The contents of an asset, valid or not.
#pragma once

#include <gltfx/inspect.hpp>

#include "model/opened_asset.hpp"
#include "schema/set.hpp"

namespace gltfx::inspect {

/// Pure except that it opens the files that the asset refers to, and reads headers of images and
/// compressed geometry. Precondition: the document has a root object. Malformed parts count as
/// absent, unreadable ones are named in `problems`. Takes time n log n in the text and the bytes of
/// compressed geometry; nothing recurses.
AssetFacts collect_facts(const model::OpenedAsset& opened, const schema::Set& schemas,
                         const InspectOptions& options);
/// The same without its external assets.
AssetFacts collect_own_facts(const model::OpenedAsset& opened, const schema::Set& schemas,
                             const InspectOptions& options);

}  // namespace gltfx::inspect
