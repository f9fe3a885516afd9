// SPDX-License-Identifier: Apache-2.0
#include "bake/lighting.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "bake/light.hpp"
#include "bake/storage.hpp"
#include "bake/studio.hpp"

namespace gltfx::bake {
namespace {

// Lux at which a white surface is white.
constexpr double kFull = std::numbers::pi;

// The illumination of the subject by its lights: the mean over the middle and corners of its box.
double lux_on(const Subject& subject, const std::vector<Light>& lights) {
  double sum = 0;
  constexpr std::size_t kMost = 4096;
  for (std::uint32_t corner = 0; corner < 9; ++corner) {
    Vec3d point = subject.middle();
    if (corner < 8) {
      point = {(corner & 1U) != 0 ? subject.least.x : subject.greatest.x,
               (corner & 2U) != 0 ? subject.least.y : subject.greatest.y,
               (corner & 4U) != 0 ? subject.least.z : subject.greatest.z};
    }
    for (std::size_t i = 0; i < std::min(lights.size(), kMost); ++i) {
      // A light at a corner does not represent the others.
      sum += std::min(luminance(illuminate(lights[i], point).irradiance), 1e6 * kFull);
    }
  }
  return sum / 9;
}

void scale(Float3& color, double factor) {
  for (float& part : color) part = static_cast<float>(static_cast<double>(part) * factor);
}

std::vector<Light> brought_to_studio(const Scene& scene, const Subject& subject, Lamps lamps) {
  if (lamps == Lamps::studio) return {};
  std::vector<Light> lights = scene.lights;
  const double lux = lux_on(subject, lights);
  if (!(lux > 0) || !std::isfinite(lux)) return lights;
  const double factor = lamps == Lamps::asset ? kFull / lux : std::min(1.0, kFull / lux);
  for (Light& light : lights) scale(light.intensity, factor);
  return lights;
}

bool is_emissive(const Scene& scene) {
  if (!scene.lights.empty()) return true;
  return std::any_of(scene.materials.begin(), scene.materials.end(), [](const auto& material) {
    return max_value(material.factors.emissive) > 0 || material.factors.unlit;
  });
}

}  // namespace

World make_world(const Scene& scene, const Subject& subject, const View& view,
                 const LightingOptions& options) {
  World world;
  const double exposure = std::exp2(options.exposure);
  const bool own = scene.environment.has_value();
  const bool studio = !own && (options.lamps != Lamps::asset || !is_emissive(scene));
  if (own || studio) {
    EnvironmentImage image = own ? *scene.environment : studio_environment(view.backward);
    for (Float3& texel : image.radiance) scale(texel, exposure);
    if (studio) world.shadow_catcher = {subject.least.y, luminance(irradiance(image, {0, 1, 0}))};
    world.environment.emplace(image);
  }
  world.emitters = Emitters(scene);
  world.lights = brought_to_studio(scene, subject, options.lamps);
  for (Light& light : world.lights) scale(light.intensity, exposure);
  if (own) world.background = Background::environment;
  if (options.transparent) world.background = Background::transparent;
  return world;
}

std::optional<Eye> eye_of(const View& view, const Bvh& bvh) {
  constexpr int kProbes = 256;
  constexpr int kWaysOut = kProbes / 16;
  constexpr double kGoldenAngle = std::numbers::pi * (3 - 2.23606797749979);
  int ways_out = 0;
  for (int i = 0; i < kProbes && ways_out <= kWaysOut; ++i) {
    const double y = 1 - (2 * i + 1.0) / kProbes;
    const double ring = std::sqrt(1 - y * y);
    const double turn = i * kGoldenAngle;
    const Ray look{view.origin, {ring * std::cos(turn), y, ring * std::sin(turn)}};
    ways_out += bvh.intersect(look, 0) ? 0 : 1;
  }
  return ways_out > kWaysOut ? std::optional(Eye(view)) : std::nullopt;
}

}  // namespace gltfx::bake
