// SPDX-License-Identifier: Apache-2.0
/// Light that comes in through walls that a ray meets (wall.hpp).
#pragma once

#include <cstdint>

#include "bake/coverage.hpp"
#include "bake/integrator.hpp"
#include "bake/storage.hpp"
#include "bake/surface.hpp"

namespace gltfx::bake {

/// Follows a ray on through walls that let light in, from the one that it hit. Calls
/// emitter(hit, surface) for what shines on it from behind them, with distances from the start of
/// the ray. True where the ray gets out of the scene.
template <class Emitter>
bool light_through(const PathSetting& setting, const Ray& ray, Hit hit, std::uint32_t key,
                   const Emitter& emitter) {
  constexpr int kMostWalls = 1024;
  const auto lets_in = [&] {
    return setting.bvh.lets_light_in(hit, ray.direction, setting.setting.eye);
  };
  Vec3d point = ray.origin + ray.direction * hit.distance;
  for (int i = 0; i < kMostWalls && lets_in(); ++i) {
    const Ray rest{beside(point, ray.direction, setting.size), ray.direction};
    const auto next = setting.bvh.intersect(rest, key, Backs::solid);
    if (!next) return true;
    hit = *next;
    point = rest.origin + rest.direction * hit.distance;
    hit.distance = length(point - ray.origin);
    if (!shines(material_of(setting.scene, setting.scene.meshes[hit.mesh]))) continue;
    const Surface surface = surface_at(setting.scene, hit, rest);
    if (!is_unseen_back(setting.scene, hit, surface)) emitter(hit, surface);
  }
  return false;
}

}  // namespace gltfx::bake
