// SPDX-License-Identifier: Apache-2.0
/// The draft of an asset: the result of a change before anything is written.
#pragma once

#include "base/result.hpp"
#include "change/change.hpp"
#include "change/draft_place.hpp"
#include "json/parse.hpp"
#include "model/opened_asset.hpp"

namespace gltfx::change {

/// The result of the edits, if they have been applied already.
struct NewText {
  SharedText text = nullptr;
  json::Parsed parsed = {};  ///< parsed text; without nodes: it is parsed on demand
};

/// The changed asset, whose resolver gives replaced and new files. Only a changed BIN chunk of a
/// GLB is copied. An Error when it has no JSON, or a GLB cannot be rewritten or would be too long.
/// Precondition: the change has been placed.
Result<model::OpenedAsset> apply(const model::OpenedAsset& before, const Change& change,
                                 NewText now, DraftPlace& place);
/// The same in memory.
Result<model::OpenedAsset> apply(const model::OpenedAsset& before, const Change& change,
                                 NewText now = {});

}  // namespace gltfx::change
