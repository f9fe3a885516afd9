// SPDX-License-Identifier: Apache-2.0
/// Cameras: from points of a picture to rays.
#pragma once

#include <gltfx/vec3.hpp>

#include "bake/ray.hpp"
#include "bake/scene.hpp"

namespace gltfx::bake {

/// A camera with a picture of a certain shape before it.
struct View {
  Vec3d origin{0, 0, 1};
  Vec3d right{1, 0, 0}, up{0, 1, 0}, backward{0, 0, 1};  ///< orthonormal
  bool perspective = true;
  /// Half the extent of the picture: at distance 1, or everywhere for an orthographic camera.
  double half_width = 0.5, half_height = 0.5;

  /// Through a point of the picture: x and y from 0 to 1, from the upper left.
  Ray ray(double x, double y) const;
};

/// The view of a camera of the asset. `aspect`: width by height of the picture. A picture of
/// another aspect than the camera's shows more, never less.
View view_of(const Camera& camera, double aspect);

}  // namespace gltfx::bake
