// SPDX-License-Identifier: Apache-2.0
/// A picture of an asset inside of the asset.
#pragma once

#include <gltfx/bake.hpp>

#include <optional>
#include <string>

#include "base/result.hpp"
#include "pipeline/edit_asset.hpp"

namespace gltfx {

/// Puts a PNG into an asset and names it as `asset.thumbnail`, the index of an image, as
/// the draft of glTF 2.1 has it; in a file of version 2.0 other programs pass over that member. In
/// a GLB the bytes go behind those of the BIN chunk, else into a data URI. An image that was the
/// thumbnail before, and surely nothing else, makes room for the new one. All else stays byte for
/// byte. An Error when the new asset would have an error that the old one has not. It is written
/// where the options ask for that.
Result<Draft> embed_thumbnail(EditedAsset asset, const BakedPixels& pixels,
                              const EditOptions& options);

/// The same in the file at `path`, which is replaced whole or not at all. Nothing when it is done,
/// else why not.
std::optional<Error> embed_thumbnail(const std::string& path, const BakedPixels& pixels,
                                     const BakeOptions& options);

}  // namespace gltfx
