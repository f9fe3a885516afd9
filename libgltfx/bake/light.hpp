// SPDX-License-Identifier: Apache-2.0
/// Punctual lights (KHR_lights_punctual).
#pragma once

#include <gltfx/vec3.hpp>

#include <span>

#include "bake/scene.hpp"

namespace gltfx::bake {

/// What a light gives to a point.
struct Illumination {
  Vec3d direction;      ///< towards the light, unit length
  double distance = 0;  ///< metres; infinite for a directional light
  Rgb irradiance;       ///< lux on a surface that faces the light; 0: none
};

/// That of one light, nothing in between.
Illumination illuminate(const Light& light, const Vec3d& point);

/// One of several lights, taken by what each gives to the point.
struct LightChoice {
  Illumination light;
  double probability = 0;  ///< 0: no light reaches the point
};
/// Of very many lights an even selection is looked at.
LightChoice choose_light(std::span<const Light> lights, const Vec3d& point, const Float2& random);

}  // namespace gltfx::bake
