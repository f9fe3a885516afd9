// SPDX-License-Identifier: Apache-2.0
/// The draft of an asset: what a change makes of it, before anything is written.
#pragma once

#include "base/result.hpp"
#include "change/change.hpp"
#include "json/parse.hpp"
#include "model/opened_asset.hpp"

namespace gltfx::change {

/// The text that the edits make, where they were made already.
struct NewText {
  SharedText text = nullptr;
  json::Parsed parsed = {};  ///< of it; without nodes: it is parsed on demand
};

/// The asset that a change makes, with replaced and new files where it looks for them. Of a GLB
/// only a changed BIN chunk is copied. An Error when it has no JSON, or a GLB cannot be written
/// anew or would be too long. Precondition: all of the change is placed.
Result<model::OpenedAsset> apply(const model::OpenedAsset& before, const Change& change,
                                 NewText now = {});

}  // namespace gltfx::change
