// SPDX-License-Identifier: Apache-2.0
/// KHR_texture_transform.
#pragma once

#include <array>
#include <cmath>

namespace gltfx::bake {

/// Rows of the affine transform of (u, v, 1): scale, then rotation, then offset. Angles are
/// counter-clockwise as one sees the image, where v points down. (The matrix that the extension's
/// text shows, read column by column as GLSL does, turns the other way; importers follow the
/// words.)
inline std::array<std::array<double, 3>, 2> texture_transform(const std::array<double, 2>& offset,
                                                              double rotation,
                                                              const std::array<double, 2>& scale) {
  const double c = std::cos(rotation);
  const double s = std::sin(rotation);
  return {{{c * scale[0], s * scale[1], offset[0]}, {-s * scale[0], c * scale[1], offset[1]}}};
}

}  // namespace gltfx::bake
