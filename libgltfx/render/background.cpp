// SPDX-License-Identifier: Apache-2.0
#include "render/background.hpp"

#include <algorithm>
#include <cmath>

#include "base/packed.hpp"

namespace gltfx::render {
namespace {

// A studio backdrop, brightest a little above the middle of the picture: chosen for its look.
// kDimBackdrop is for subjects with too little contrast to it.
Rgb backdrop(double x, double y) {
  const double dx = x - 0.5;
  const double dy = y - 0.46;
  const double away = smooth_step(0.1, 0.85, std::sqrt(dx * dx + dy * dy));
  return Rgb(0.76, 0.765, 0.775) * (1 - away) + Rgb(0.47, 0.48, 0.50) * away;
}

}  // namespace

double smooth_step(double from, double to, double x) {
  const double t = std::clamp((x - from) / (to - from), 0.0, 1.0);
  return t * t * (3 - 2 * t);
}

Rgb background(const TraceContext& context, const Vec3d& direction, const Float2& point) {
  const World& world = context.world;
  if (world.background == Background::environment && world.environment) {
    return world.environment->radiance(direction);
  }
  if (world.background != Background::backdrop) return {};
  return backdrop(static_cast<double>(point[0]), static_cast<double>(point[1])) * world.backdrop;
}

double catcher_shadow(const TraceContext& context, const Ray& ray, const Float2& random,
                      std::uint32_t& rays) {
  constexpr double kDepth = 0.7;  // maximum of the shadow: chosen for its look, never black
  const World& world = context.world;
  if (!world.shadow_catcher || !world.environment || ray.direction.y >= 0) return 0;
  const double distance = (world.shadow_catcher->height - ray.origin.y) / ray.direction.y;
  if (!(distance > 0)) return 0;
  const Vec3d point =
      beside(ray.origin + ray.direction * distance, Vec3d(0, 1, 0), context.scene_size);
  const EnvironmentSample light = world.sample_sky({Vec3d(0, 1, 0)}, random);
  if (!(light.pdf > 0) || light.direction.y <= 0) return 0;
  ++rays;
  const double kept =
      1 - static_cast<double>(context.bvh.visibility({point, light.direction}, world.eye));
  if (kept == 0) return 0;
  const double share = luminance(light.radiance) * light.direction.y * light.scale;
  return kept * share / world.shadow_catcher->irradiance * kDepth;
}

}  // namespace gltfx::render
