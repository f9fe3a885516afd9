// SPDX-License-Identifier: Apache-2.0
/// Quick looks at packed keyframes: most curves need no closer one, and rigs have thousands.
#pragma once

#include <cstddef>

namespace gltfx::validate {

/// Whether two neighbours of `count` vectors of four have a dot product between -`limit` and
/// `limit`, as quaternions half a turn apart.
bool has_right_angle(const float* vectors, std::size_t count, float limit);

/// Whether a component of two neighbours of `count` vectors of three has different signs.
bool has_sign_change(const float* vectors, std::size_t count);

}  // namespace gltfx::validate
