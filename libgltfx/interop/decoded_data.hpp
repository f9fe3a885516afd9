// SPDX-License-Identifier: Apache-2.0
/// Decodes data that tinygltf does not decode itself.
#pragma once

#include "interop/notes.hpp"
#include "model/geometry.hpp"

namespace gltfx::interop {

/// Decodes compressed accessors, and expands sparse ones if `expand_sparse`, in a model whose
/// buffers have their bytes. New bytes go into the first empty buffer, or into a new one; indices
/// do not change. Takes memory for the decoded data, and a fixed amount for expanded accessors.
/// Notes fail when something cannot be decoded, or a buffer that is needed has no bytes.
void place_decoded(const model::GeometrySource& source, bool expand_sparse, tinygltf::Model& model,
                   Notes& notes);

}  // namespace gltfx::interop
