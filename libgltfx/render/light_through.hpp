// SPDX-License-Identifier: Apache-2.0
/// Light that comes in through walls that a ray hits (wall.hpp).
#pragma once

#include <cstdint>

#include "base/packed.hpp"
#include "render/integrator.hpp"
#include "render/surface.hpp"

namespace gltfx::render {

/// Continues a ray that has hit a wall through all walls that let light in. Calls emitter(hit,
/// surface) for the surfaces behind them, with distances from the start of the ray. True if the ray
/// leaves the scene.
template <class Emitter>
bool light_through(const TraceContext& context, const Ray& ray, Hit hit, Surface surface,
                   std::uint32_t key, const Emitter& emitter) {
  constexpr int kMostWalls = 1024;
  for (int i = 0; i < kMostWalls; ++i) {
    if (!context.bvh.lets_light_in(hit, ray.direction, context.world.eye)) return false;
    const Vec3d start = beside(surface.position, -surface.flat_normal, context.scene_size);
    const Ray rest{start, ray.direction};
    const auto next = context.bvh.intersect(rest, key, Backs::solid);
    if (!next) return true;
    hit = *next;
    surface = surface_at(context.scene, hit, rest);
    if (is_unseen_back(context.scene, hit, surface)) return false;
    hit.distance = length(surface.position - ray.origin);
    if (!surface.material.unlit) emitter(hit, surface);
  }
  return false;
}

}  // namespace gltfx::render
