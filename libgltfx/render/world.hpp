// SPDX-License-Identifier: Apache-2.0
/// The world around a scene: lights and background.
#pragma once

#include <limits>
#include <optional>
#include <vector>

#include "render/environment.hpp"
#include "render/light.hpp"
#include "render/ray.hpp"
#include "render/scene.hpp"
#include "render/sky_samples.hpp"
#include "render/wall.hpp"

namespace gltfx::render {

/// The background of the picture.
enum class Background : std::uint8_t { backdrop, environment, transparent };

/// A level floor that is invisible except for the shadow on it.
struct ShadowCatcher {
  double height = 0;
  double irradiance = 0;  ///< by the environment, unoccluded; luminance
};

struct World {
  std::optional<Environment> environment;
  std::optional<SkySamples> sky;  ///< of the environment; none: each surface samples it separately
  /// Surfaces farther away from the lit point do not occlude the environment, so that it shines
  /// into closed rooms.
  double sky_occlusion = std::numeric_limits<double>::infinity();
  std::vector<Light> lights;
  Emitters emitters;  ///< sampled ones of the scene; BSDF sampling finds the others
  Background background = Background::backdrop;
  double backdrop = 1;                          ///< factor of the radiance of the backdrop
  std::optional<ShadowCatcher> shadow_catcher;  ///< only with a backdrop
  /// Decides which walls let light in. Nothing: all walls that turn their backs to the light.
  std::optional<Eye> eye;

  /// A direction to the environment. Precondition: there is an environment.
  EnvironmentSample sample_sky(const Receiver& receiver, const Float2& random) const {
    return sky ? sky->choose(receiver, random) : environment->sample(random);
  }
  /// The environment in a direction, and the density there of directions with `sky_pdf`.
  EnvironmentValue evaluate_sky(const Vec3d& direction, const SkyPdf& sky_pdf) const {
    if (!sky_pdf) return environment->evaluate(direction);
    const Rgb radiance = environment->radiance(direction);
    return {radiance, sky_pdf(direction, radiance)};
  }
  /// The density of `count` such directions.
  SkyPdf sky_pdf(const Receiver& receiver, std::uint32_t count) const {
    return sky ? sky->pdf(receiver, count) : SkyPdf{receiver};
  }
};

}  // namespace gltfx::render
