// SPDX-License-Identifier: Apache-2.0
/// The local transform of a node.
#pragma once

#include "measure/source.hpp"
#include "model/node.hpp"

namespace gltfx::measure {

/// As it is stored, relative to the parent.
inline model::Affine stored_transform(const Source& source, model::NodeIndex node) {
  return model::stored_transform(source.asset(), source.views().nodes[node]);
}

/// Whether no number of the matrix differs from the identity by more than 1e-5.
bool is_identity(const model::Affine& transform);

}  // namespace gltfx::measure
