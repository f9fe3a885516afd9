// SPDX-License-Identifier: Apache-2.0
/// Light along single rays, averaged over samples.
#pragma once

#include <cmath>
#include <cstdint>
#include <memory>
#include <utility>

#include <gtest/gtest.h>

#include "render/integrator.hpp"
#include "shapes.hpp"
#include "simple_integrator.hpp"

namespace gltfx::render {

/// A mean and its standard error, by colour.
struct Estimate {
  Rgb mean, error;
};

/// Radiance 1 from everywhere, or another one.
inline EnvironmentImage even_light(float radiance = 1) {
  EnvironmentImage image;
  image.width = 2;
  image.height = 1;
  image.radiance = {{radiance, radiance, radiance}, {radiance, radiance, radiance}};
  return image;
}

/// Light along a ray.
inline PathSample trace_ray(const TraceContext& context, const CameraSample& camera) {
  return trace_path(context, camera, context.bvh.first_layer(camera.ray));
}

/// A scene and what surrounds it.
class Stage {
 public:
  explicit Stage(Scene scene)
      : scene_(std::make_unique<const Scene>(std::move(scene))), bvh_(build(*scene_)) {}

  World world;
  int bounces = 8;
  ShaderMode mode = ShaderMode::conserving;

  /// Else they are found by chance.
  void find_emitters() { world.emitters = Emitters(*scene_); }

  TraceContext context() const { return {*scene_, bvh_, world, bounces, 1, mode}; }

  template <class Trace>
  Estimate estimate(std::uint32_t samples, std::uint32_t seed, const Trace& trace) const {
    Rgb sum;
    Rgb squares;
    for (std::uint32_t i = 0; i < samples; ++i) {
      // Each in a separate pixel: evenly spread samples would have a smaller error than estimated.
      const Rgb value = trace(SampleStream(seed, i, 0));
      sum += value;
      squares += value * value;
    }
    const double count = samples;
    const Rgb mean = sum / Rgb(count);
    const Rgb spread = squares / Rgb(count) - mean * mean;
    const auto error = [count](double v) { return std::sqrt(std::fmax(v, 0) / count); };
    return {mean, {error(spread.x), error(spread.y), error(spread.z)}};
  }

  Estimate path(const Ray& ray, std::uint32_t samples = 4000) const {
    const TraceContext s = context();
    return estimate(samples, 1, [&](const SampleStream& random) {
      return trace_ray(s, {ray, {0.5F, 0.5F}, random}).radiance();
    });
  }

  Estimate simply(const Ray& ray, std::uint32_t samples = 40000) const {
    const TraceContext s = context();
    return estimate(samples, 2,
                    [&](const SampleStream& random) { return trace_simply(s, ray, random); });
  }

 private:
  static Bvh build(const Scene& scene) {
    auto bvh = Bvh::build(scene);
    EXPECT_TRUE(bvh);
    return *std::move(bvh);
  }

  std::unique_ptr<const Scene> scene_;  // in its place when the stage is moved
  Bvh bvh_;
};

/// A material that scatters light evenly: no reflection at its surface.
inline SceneMaterial matte(const Rgb& color) {
  SceneMaterial material;
  material.factors.base_color = color;
  material.factors.metallic = 0;
  material.factors.roughness = 1;
  material.factors.specular = 0;
  return material;
}

inline void expect_near(const Estimate& estimate, const Rgb& expected, double tolerance = 1e-6) {
  EXPECT_NEAR(estimate.mean.x, expected.x, 3.5 * estimate.error.x + tolerance);
  EXPECT_NEAR(estimate.mean.y, expected.y, 3.5 * estimate.error.y + tolerance);
  EXPECT_NEAR(estimate.mean.z, expected.z, 3.5 * estimate.error.z + tolerance);
}

}  // namespace gltfx::render
