// SPDX-License-Identifier: Apache-2.0
/// A picture of an asset inside of the asset.
#pragma once

#include <gltfx/bake.hpp>

#include <optional>
#include <string>

#include "base/result.hpp"

namespace gltfx {

/// Puts a PNG into the file at `path` and names it as `asset.thumbnail`, the index of an image, as
/// the draft of glTF 2.1 has it; in a file of version 2.0 other programs pass over that member. In
/// a GLB the bytes go behind those of the BIN chunk, else into a data URI. An image that was the
/// thumbnail before, and surely nothing else, makes room for the new one. All else stays byte for
/// byte; the file is replaced whole, unless the new one has an error that the old one has not, or
/// not at all. Nothing when it is done, else why not.
std::optional<Error> embed_thumbnail(const std::string& path, const BakedPixels& pixels,
                                     const BakeOptions& options);

}  // namespace gltfx
