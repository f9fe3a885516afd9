// SPDX-License-Identifier: Apache-2.0
/// Where new bytes go: into the BIN chunk of a GLB, into new files beside the old ones, or into
/// data URIs where the old ones are in such. New contents of a buffer replace the old ones.
#pragma once

#include <functional>
#include <string>
#include <string_view>

#include "base/result.hpp"
#include "change/change.hpp"
#include "model/opened_asset.hpp"

namespace gltfx::change {

/// Whether a new file may have that path: nothing is there, or exactly these bytes.
using IsFree = std::function<bool(const std::string& path, std::string_view bytes)>;

/// The change with a place for all that it adds, and none of that left. What is put behind the BIN
/// chunk is aligned to 4 bytes. Files are named after those that they stand beside and after their
/// own content; `is_free` may be null where there are no additions. An Error when there is no
/// place, when the bytes of a buffer are missing, or when two buffers with new contents are one
/// file. Precondition: no edit of the change is about a root array that grows, the length of buffer
/// 0 where it grows, or the data URI of a buffer with new contents.
Result<Change> place(Change change, const model::OpenedAsset& asset, const IsFree& is_free);

}  // namespace gltfx::change
