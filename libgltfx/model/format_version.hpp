// SPDX-License-Identifier: Apache-2.0
/// Which glTF a document is.
#pragma once

#include "json/document.hpp"

namespace gltfx::model {

/// Whether a document is glTF 1.0 by its `asset.version`, a string or a number, or without one by
/// its shaders and the dictionaries that stood in place of arrays.
bool is_gltf_1(const json::Document& document);

}  // namespace gltfx::model
