// SPDX-License-Identifier: Apache-2.0
/// Path tracing, from the camera over surfaces and through media to lights.
#pragma once

#include <gltfx/material.hpp>

#include <cstdint>
#include <optional>

#include "render/bvh.hpp"
#include "render/sampler.hpp"
#include "render/scene.hpp"
#include "render/view.hpp"
#include "render/world.hpp"

namespace gltfx::render {

/// Features of the surface that is seen, for the denoiser and extra layers; 0 beside the scene.
struct Features {
  Rgb albedo;           ///< of surfaces or media that scatter light
  Rgb specular_albedo;  ///< tint of mirrors and gloss, at normal incidence
  Vec3d normal;
  double depth = 0;  ///< along the ray
  std::uint32_t material = kNone;
  bool clear = false;  ///< the surface is, or may be, seen straight through glass

  /// Adds those of another sample, weighted.
  void add(const Features& sample, double weight);
};

/// Light and features along one camera ray.
struct PathSample {
  Rgb reflected;      ///< by mirrors and gloss of the first surface
  Rgb scattered;      ///< otherwise, by surfaces and media
  Rgb emitted;        ///< by the first surface
  Rgb background;     ///< its visible part, without shadow
  double shadow = 0;  ///< part of the background that shadow takes away
  double alpha = 0;   ///< 1 on the scene, 0 beside it, between them where both are visible
  Features features;
  std::uint32_t rays = 0;  ///< that were traced

  Rgb radiance() const { return reflected + scattered + emitted + background * (1 - shadow); }
  /// Adds light; the first surface reflects a share of it, by colour.
  void add_light(const Rgb& light, const Rgb& reflected_share) {
    reflected += light * reflected_share;
    scattered += light * (Rgb(1) - reflected_share);
  }
  /// Adds another sample, weighted.
  void add(const PathSample& sample, double weight);
};

/// Work of a path at its first surface, and after it.
struct Effort {
  std::uint32_t light_samples = 4;     ///< shadow rays to each kind of light
  std::uint32_t light_candidates = 2;  ///< emitters for each of them
  std::uint32_t transmitted_paths =
      4;  ///< branches of light that is transmitted, which varies most
  /// Later surfaces that are opaque and rough get the light of an unoccluded sky, and end the path.
  bool sky_ends_paths = false;
};

/// Data that all paths of a picture share. References must outlive it.
struct TraceContext {
  const Scene& scene;
  const Bvh& bvh;
  const World& world;
  int max_depth = 4;      ///< surfaces that scatter along a path
  double scene_size = 1;  ///< for distances that count as zero
  ShaderMode mode = ShaderMode::conserving;
  Effort effort{};
};

/// Light that arrives along a ray that comes from a point of the picture, with next event
/// estimation, multiple importance sampling and Russian roulette. `first`: the first layer along
/// the ray.
PathSample trace_path(const TraceContext& context, const CameraSample& camera,
                      const std::optional<Hit>& first);

/// A feature sample: features and emission of the first surface, or the background. Without light
/// on the surface, shadow, or objects behind glass.
PathSample sample_features(const TraceContext& context, const CameraSample& camera,
                           const std::optional<Hit>& first);

}  // namespace gltfx::render
