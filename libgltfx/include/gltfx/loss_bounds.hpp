// SPDX-License-Identifier: Apache-2.0
/// @file
/// Bounds of the loss that a conversion may cause, and that a comparison tolerates.
#pragma once

#include <optional>

namespace gltfx {

/// The greatest permitted loss of each quantity; nothing: the quantity stays exact.
struct LossBounds {
  /// Distance of a corner in the space of the scene, as a part of the diagonal of the box of the
  /// default scene at rest; of a mesh that is in no scene, of its own box.
  std::optional<double> position = 1e-4;
  /// Angle of normals and tangents, in degrees.
  std::optional<double> normal = 0.5;
  /// Distance of texture coordinates, in texels of the longest side of any image of the asset.
  std::optional<double> texcoord = 0.25;
  /// Difference of a component of vertex colors, from 0 to 1.
  std::optional<double> color = 0.5 / 255;
  /// Difference of a weight of a joint, from 0 to 1.
  std::optional<double> weight = 5e-4;
  /// Difference of a component of animated values, as a part of the greatest absolute component of
  /// the curve; of rotations 1.
  std::optional<double> animation;
};

}  // namespace gltfx
