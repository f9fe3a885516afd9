// SPDX-License-Identifier: Apache-2.0
#include "bake/background.hpp"

#include "bake/storage.hpp"
#include "bake/studio.hpp"

namespace gltfx::bake {

Rgb background(const PathSetting& setting, const Vec3d& direction, const Float2& point) {
  const Setting& s = setting.setting;
  if (s.background == Background::environment && s.environment) {
    return s.environment->radiance(direction);
  }
  if (s.background != Background::backdrop) return {};
  return backdrop(static_cast<double>(point[0]), static_cast<double>(point[1]));
}

double floor_shadow(const PathSetting& setting, const Ray& ray, const Float2& random,
                    std::uint32_t& rays) {
  constexpr double kDepth = 0.7;  // how dark the floor becomes
  const Setting& s = setting.setting;
  if (!s.floor || !s.environment || ray.direction.y >= 0) return 0;
  const double distance = (s.floor->height - ray.origin.y) / ray.direction.y;
  if (!(distance > 0)) return 0;
  const Vec3d point = beside(ray.origin + ray.direction * distance, Vec3d(0, 1, 0), setting.size);
  const EnvironmentSample light = s.environment->sample(random);
  if (!(light.pdf > 0) || light.direction.y <= 0) return 0;
  ++rays;
  const double kept =
      1 - static_cast<double>(setting.bvh.visibility({point, light.direction}, s.eye));
  if (kept == 0) return 0;
  const double share = luminance(s.environment->radiance(light)) * light.direction.y / light.pdf;
  return kept * share / s.floor->irradiance * kDepth;
}

}  // namespace gltfx::bake
