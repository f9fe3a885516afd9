// SPDX-License-Identifier: Apache-2.0
/// Removes changes of what is not drawn.
#pragma once

#include "prove/changes.hpp"

namespace gltfx::prove {

/// For CompareOptions::drawn: of objects that no scene leads to, of cameras, of extensions that are
/// never drawn, of values of a material that do not change its looks, and of weights of morph
/// targets that another value overrides. May be called again after more comparisons.
void forget_undrawn(const Comparison& comparison);

}  // namespace gltfx::prove
