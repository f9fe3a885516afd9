// SPDX-License-Identifier: Apache-2.0
/// Vectors in storage, packed and without padding, and their conversion to those of arithmetic.
#pragma once

#include <gltfx/vec3.hpp>

#include <array>
#include <cmath>

namespace gltfx {

using Float2 = std::array<float, 2>;
using Float3 = std::array<float, 3>;
using Float4 = std::array<float, 4>;

inline Vec3d to_vec(const Float3& a) { return {a[0], a[1], a[2]}; }
inline Float3 to_float3(const Vec3d& a) {
  return {static_cast<float>(a.x), static_cast<float>(a.y), static_cast<float>(a.z)};
}

inline double length(const Vec3d& a) { return std::sqrt(dot(a, a)); }
/// Relative luminance of linear Rec. 709.
constexpr double luminance(const Rgb& c) { return 0.2126 * c.x + 0.7152 * c.y + 0.0722 * c.z; }

}  // namespace gltfx
