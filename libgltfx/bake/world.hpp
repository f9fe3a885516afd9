// SPDX-License-Identifier: Apache-2.0
/// What surrounds a scene: its light, and what is seen where it is not.
#pragma once

#include <optional>
#include <vector>

#include "bake/emitters.hpp"
#include "bake/environment.hpp"
#include "bake/ray.hpp"
#include "bake/scene.hpp"
#include "bake/wall.hpp"

namespace gltfx::bake {

/// What the picture shows behind the scene.
enum class Background : std::uint8_t { backdrop, environment, transparent };

/// A level floor that nobody sees but for the shadow on it.
struct ShadowCatcher {
  double height = 0;
  double irradiance = 0;  ///< luminance of what the environment gives it with nothing in the way
};

struct World {
  std::optional<Environment> environment;
  std::vector<Light> lights;
  Emitters emitters;  ///< of the scene; those not named are found by chance
  Background background = Background::backdrop;
  std::optional<ShadowCatcher> shadow_catcher;  ///< only with a backdrop
  /// Which walls let light in. Nothing: all that turn their backs to it.
  std::optional<Eye> eye;
};

}  // namespace gltfx::bake
