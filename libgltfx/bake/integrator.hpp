// SPDX-License-Identifier: Apache-2.0
/// Light along paths: from the camera over surfaces and through media to lights.
#pragma once

#include <gltfx/material.hpp>

#include <cstdint>

#include "bake/bvh.hpp"
#include "bake/sampler.hpp"
#include "bake/scene.hpp"
#include "bake/setting.hpp"
#include "bake/view.hpp"

namespace gltfx::bake {

/// What is known of the surface that is seen, for the denoiser and extra layers; 0 beside the
/// scene.
struct Features {
  Rgb albedo;           ///< of what scatters light
  Rgb specular_albedo;  ///< tint of mirrors and gloss, at normal incidence
  Vec3d normal;
  double depth = 0;  ///< along the ray
  std::uint32_t material = kNone;
  bool clear = false;  ///< something is or may be seen straight through glass

  /// Adds those of another sample, weighted.
  void add(const Features& sample, double weight);
};

/// What one path brings back.
struct PathSample {
  Rgb reflected;      ///< by mirrors and gloss of the surface that is seen first
  Rgb scattered;      ///< otherwise, by surfaces and media
  Rgb emitted;        ///< by what is seen first
  Rgb background;     ///< as far as it is seen, without shadow
  double shadow = 0;  ///< part of the background that shadow takes away
  double alpha = 0;   ///< 1 on the scene, 0 beside it, between them where it is seen through
  Features features;
  std::uint32_t rays = 0;  ///< that were traced

  Rgb radiance() const { return reflected + scattered + emitted + background * (1 - shadow); }
  /// Light of which the surface that is seen first reflects a part, by colour.
  void add_light(const Rgb& light, const Rgb& reflected_share) {
    reflected += light * reflected_share;
    scattered += light * (Rgb(1) - reflected_share);
  }
  /// Adds another sample, weighted.
  void add(const PathSample& sample, double weight);
};

/// What all paths of a picture share. References must outlive it.
struct PathSetting {
  const Scene& scene;
  const Bvh& bvh;
  const Setting& setting;
  int bounces = 4;  ///< surfaces at most that scatter along a path
  double size = 1;  ///< of the scene, for distances that count as none
  ShaderMode mode = ShaderMode::conserving;
  std::uint32_t tries = 4;  ///< for a light, where the camera looks: fewer do with many samples
};

/// Light that arrives along a ray that comes from a point of the picture (x and y from 0 to 1),
/// with next event estimation, multiple importance sampling and Russian roulette.
PathSample trace_path(const PathSetting& setting, const Ray& ray, const Float2& point,
                      const SampleStream& random);

/// A feature sample: features, emission and background of what is seen first, without light on it,
/// shadow, or anything behind glass.
PathSample sample_features(const PathSetting& setting, const Ray& ray, const Float2& point,
                           const SampleStream& random);

/// Light along a ray by other means, as a test of the first: directions are taken evenly but on
/// glass and mirrors, lights other than punctual ones are found by chance only, media are followed
/// collision by collision in one colour, and no path is given up or split.
Rgb trace_simply(const PathSetting& setting, const Ray& ray, const SampleStream& random);

}  // namespace gltfx::bake
