// SPDX-License-Identifier: Apache-2.0
/// The least and greatest numbers of an accessor.
#pragma once

namespace tinygltf {
class Model;
struct Accessor;
}  // namespace tinygltf

namespace gltfx::interop {

/// Sets `minValues` and `maxValues`, those of them that are there, to what the bytes of the model
/// hold. False when they said so before, or when the elements do not lie plain: sparse ones, and
/// matrices of small numbers. Precondition: the accessor has a buffer view and lies inside it.
bool restate_bounds(const tinygltf::Model& model, tinygltf::Accessor& accessor);

}  // namespace gltfx::interop
