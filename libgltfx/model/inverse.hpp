// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "model/node.hpp"

namespace gltfx::model {

/// The transform that undoes another one; nothing if its volume is 0, too small for a normal
/// double, or not finite.
std::optional<Affine> inverse(const Affine& of);

}  // namespace gltfx::model
