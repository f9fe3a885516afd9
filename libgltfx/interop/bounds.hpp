// SPDX-License-Identifier: Apache-2.0
/// The minima and maxima of an accessor.
#pragma once

namespace tinygltf {
class Model;
struct Accessor;
}  // namespace tinygltf

namespace gltfx::interop {

/// Sets `minValues` and `maxValues`, if present, to the bounds of the values in the model. False
/// when they were right before, or when the elements are not contiguous: sparse accessors, and
/// padded matrices. Precondition: the accessor has a buffer view and is inside it.
bool restate_bounds(const tinygltf::Model& model, tinygltf::Accessor& accessor);

}  // namespace gltfx::interop
