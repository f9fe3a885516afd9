// SPDX-License-Identifier: Apache-2.0
/// Fixes of cubic splines. Their subject is `output` of a sampler.
#pragma once

#include "rules/fix.hpp"

namespace gltfx::validate {

/// Negates keys of rotations, with their tangents, so that no two neighbours have a negative dot
/// product.
bool negate_keys(Fixing& fixing, const Subject& subject);

/// Sets all tangents to 0.
bool clear_tangents(Fixing& fixing, const Subject& subject);

}  // namespace gltfx::validate
