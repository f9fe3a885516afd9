// SPDX-License-Identifier: Apache-2.0
/// Cameras (specification section 3.10). A camera looks along -Z of its node, with +Y upwards.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <string>

#include "model/properties.hpp"

namespace gltfx::model {

struct Camera {
  std::string name;
  bool perspective = true;
  float y_fov = 0;         ///< full angle in radians; of a perspective camera
  float aspect_ratio = 0;  ///< width by height; 0: that of the picture
  float x_mag = 0;         ///< half the width; of an orthographic camera
  float y_mag = 0;         ///< half the height; likewise
  float z_near = 0;
  float z_far = std::numeric_limits<float>::infinity();
};

/// The camera at `index`, or nothing when it lacks a member that its projection needs.
std::optional<Camera> read_camera(const Asset& asset, std::uint32_t index,
                                  const AnimatedValues* animated = nullptr);

}  // namespace gltfx::model
