// SPDX-License-Identifier: Apache-2.0
/// Places new bytes: into the BIN chunk of a GLB, into new files beside the old ones, or into
/// data URIs if the old ones are. New contents of a buffer replace the old ones.
#pragma once

#include <functional>
#include <string>
#include <string_view>

#include "base/result.hpp"
#include "change/change.hpp"
#include "model/opened_asset.hpp"

namespace gltfx::change {

/// Whether a new file may have that path: it does not exist, or has exactly these bytes.
using IsFree = std::function<bool(const std::string& path, std::string_view bytes)>;

/// The change with all additions placed and removed from `additions`. Bytes appended to the BIN
/// chunk are aligned to 4 bytes. Files are named after the file beside them and after their own
/// content; `is_free` may be null without additions. An Error when there is no place, when the
/// bytes of a buffer are missing, or when two buffers with new contents are one file. Precondition:
/// no edit of the change affects a root array that grows, the length of buffer 0 if it grows, or
/// the data URI of a buffer with new contents.
Result<Change> place(Change change, const model::OpenedAsset& asset, const IsFree& is_free);

}  // namespace gltfx::change
