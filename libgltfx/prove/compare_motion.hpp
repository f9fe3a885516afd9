// SPDX-License-Identifier: Apache-2.0
/// Compares animations: what their channels move, and the values at all times.
#pragma once

#include "prove/compare_values.hpp"

namespace gltfx::prove {

void compare_motion(const Comparison& comparison, const Helpers& helpers);

}  // namespace gltfx::prove
