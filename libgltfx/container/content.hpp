// SPDX-License-Identifier: Apache-2.0
/// What bytes are that stand where an asset, a buffer or an image should, told by their beginning.
#pragma once

#include <string_view>

namespace gltfx::container {

struct Content {
  std::string_view name;        ///< "a GIF", "an HTML page (a failed download?)"; or empty
  std::string_view media_type;  ///< of an image that no part of glTF itself knows; or empty
  bool image = false;           ///< some reader may take it for an image
};

/// Names formats that glTF has no use for, and those that only extensions bring. PNG, JPEG, WebP
/// and KTX 2 are named where they are too short to be read. No name: nothing that is known here.
Content name_content(std::string_view bytes);

}  // namespace gltfx::container
