// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <numbers>

#include "bake/integrator.hpp"
#include "bake/light.hpp"
#include "bake/material.hpp"
#include "bake/storage.hpp"
#include "bake/surface.hpp"

namespace gltfx::bake {
namespace {

constexpr double kSphere = 4 * std::numbers::pi;

// Evenly over all directions.
Vec3d any_direction(const Float2& random) {
  const double z = 1 - 2 * static_cast<double>(random[0]);
  const double ring = std::sqrt(std::fmax(0.0, 1 - z * z));
  const double turn = 2 * std::numbers::pi * static_cast<double>(random[1]);
  return {ring * std::cos(turn), ring * std::sin(turn), z};
}

bool is_consistent(const Surface& surface, const Vec3d& direction, const Vec3d& l) {
  return (dot(direction, surface.flat_normal) > 0) == (l.z > 0);
}

Vec3d start(const PathSetting& s, const Surface& surface, bool outside) {
  return beside(surface.position, outside ? surface.flat_normal : -surface.flat_normal, s.size);
}

Rgb from_lamps(const PathSetting& s, const Surface& surface, const Vec3d& v) {
  Rgb sum;
  for (const Light& each : s.setting.lights) {
    const Illumination lamp = illuminate(each, surface.position);
    const Vec3d l = surface.frame.to_local(lamp.direction);
    if (max_value(lamp.irradiance) <= 0 || !is_consistent(surface, lamp.direction, l)) continue;
    const Ray towards{start(s, surface, l.z > 0), lamp.direction, lamp.distance};
    const double seen = static_cast<double>(s.bvh.visibility(towards));
    sum += evaluate(surface.material, v, l, {s.mode}) * lamp.irradiance * (std::fabs(l.z) * seen);
  }
  return sum;
}

}  // namespace

Rgb trace_simply(const PathSetting& s, const Ray& first, const SampleStream& random) {
  Rgb result;
  Rgb throughput{1, 1, 1};
  Ray ray = first;
  for (int step = 0; step <= s.bounces; ++step) {
    const auto dimension = static_cast<std::uint32_t>(step) + 1;
    const auto hit = s.bvh.intersect(ray, random.key() + dimension);
    if (!hit) {
      if (!s.setting.environment) return result;
      return result + throughput * s.setting.environment->radiance(ray.direction);
    }
    const Surface surface = surface_at(s.scene, *hit, ray);
    const Vec3d v = surface.frame.to_local(-ray.direction);
    result += throughput * emitted(surface.material, v);
    if (step == s.bounces || surface.material.unlit) return result;
    result += throughput * from_lamps(s, surface, v);
    const Vec3d direction = any_direction(random.pair(dimension));
    const Vec3d l = surface.frame.to_local(direction);
    if (!is_consistent(surface, direction, l)) return result;
    throughput *= evaluate(surface.material, v, l, {s.mode}) * (std::fabs(l.z) * kSphere);
    ray = {start(s, surface, l.z > 0), direction};
  }
  return result;
}

}  // namespace gltfx::bake
