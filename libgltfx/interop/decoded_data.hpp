// SPDX-License-Identifier: Apache-2.0
/// What tinygltf does not decode, as plain accessors.
#pragma once

#include "interop/notes.hpp"
#include "model/geometry.hpp"

namespace gltfx::interop {

/// Decodes what is compressed, and expands what is sparse when asked to, in a model whose buffers
/// have their bytes. New bytes go into the first buffer that has none, or into a new one; indices
/// stay what they are. Takes memory only for what decoders gave, and a fixed amount for accessors
/// that are expanded. Notes fail when something cannot be decoded, or a buffer that is needed has
/// no bytes.
void place_decoded(const model::GeometrySource& source, bool expand_sparse, tinygltf::Model& model,
                   Notes& notes);

}  // namespace gltfx::interop
