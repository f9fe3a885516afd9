// SPDX-License-Identifier: Apache-2.0
/// Punctual lights (KHR_lights_punctual).
#pragma once

#include <gltfx/vec3.hpp>

#include <span>

#include "bake/scene.hpp"

namespace gltfx::bake {

/// The light of a punctual light at a point.
struct Illumination {
  Vec3d direction;      ///< towards the light, unit length
  double distance = 0;  ///< metres; infinite for a directional light
  Rgb irradiance;       ///< lux on a surface that faces the light; 0: none
};

/// The illumination by one light, unoccluded.
Illumination illuminate(const Light& light, const Vec3d& point);

/// One of several lights, chosen by their illumination of the point.
struct LightChoice {
  Illumination light;
  double probability = 0;  ///< 0: no light reaches the point
};
/// Of very many lights, an evenly spaced selection is evaluated.
LightChoice choose_light(std::span<const Light> lights, const Vec3d& point, const Float2& random);

}  // namespace gltfx::bake
