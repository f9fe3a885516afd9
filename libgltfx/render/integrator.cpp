// SPDX-License-Identifier: Apache-2.0
#include "render/integrator.hpp"

#include <algorithm>
#include <optional>

#include "base/packed.hpp"
#include "render/background.hpp"
#include "render/radiance.hpp"
#include "render/surface.hpp"

namespace gltfx::render {
namespace {

constexpr std::uint32_t kLayers = 4;        // of alpha, before the camera
constexpr double kLeastWeight = 1.0 / 512;  // weight of a layer

// With dispersion each colour has a separate path.
std::uint32_t colors_at(const Scene& scene, const Hit& hit) {
  const Material& factors = material_of(scene, scene.meshes[hit.mesh]).factors;
  return factors.dispersion > 0 && factors.transmission > 0 ? 3 : 1;
}

// Layers of alpha in front of the camera are not sampled at random: each has a separate path,
// weighted by its coverage times the transmittance of the layers before it.
template <class Trace>
PathSample blend_layers(const TraceContext& context, const CameraSample& camera,
                        std::optional<Hit> hit, const Trace& trace) {
  PathSample sum;
  Ray rest = camera.ray;
  double left = 1;
  for (std::uint32_t layer = 0;; ++layer) {
    const bool last = layer + 1 == kLayers;
    if (last) {
      hit = context.bvh.intersect(rest, camera.random.key());
    } else if (layer > 0) {
      hit = context.bvh.first_layer(rest);
    }
    const double covered = hit && !last ? static_cast<double>(context.bvh.coverage(*hit)) : 1.0;
    sum.add(trace(rest, hit, layer), left * covered);
    left *= 1 - covered;
    if (left < kLeastWeight) return sum;
    const Vec3d behind = rest.origin + rest.direction * hit->distance;
    rest.origin = beside(behind, rest.direction, context.scene_size);
  }
}

template <class Trace>
PathSample through_layers(const TraceContext& context, const CameraSample& camera,
                          const std::optional<Hit>& hit, const Trace& trace) {
  const bool single = !hit || context.bvh.coverage(*hit) >= 1;
  return single ? trace(camera.ray, hit, 0) : blend_layers(context, camera, hit, trace);
}

}  // namespace

void PathSample::add(const PathSample& sample, double weight) {
  scattered += sample.scattered * weight;
  reflected += sample.reflected * weight;
  emitted += sample.emitted * weight;
  const double seen = luminance(sample.background) * weight;
  if (seen > 0) {
    const double before = luminance(background);
    shadow = (shadow * before + sample.shadow * seen) / (before + seen);
    background += sample.background * weight;
  }
  alpha += sample.alpha * weight;
  features.add(sample.features, weight);
  rays += sample.rays;
}

PathSample trace_path(const TraceContext& context, const CameraSample& camera,
                      const std::optional<Hit>& first) {
  const auto trace = [&](const Ray& rest, const std::optional<Hit>& hit, std::uint32_t layer) {
    const std::uint32_t colors = hit ? colors_at(context.scene, *hit) : 1;
    const auto trace_color = [&](std::uint32_t i) {
      PathState path{rest, PathSampler(camera.random, layer).split(i, colors)};
      FeatureRecorder features;
      PathSample sample = incident_radiance(context, path, features, hit, camera.point);
      sample.alpha = std::clamp(sample.alpha, 0.0, 1.0);
      ++sample.rays;
      return sample;
    };
    if (colors == 1) return trace_color(0);
    PathSample sum;
    for (std::uint32_t i = 0; i < colors; ++i) sum.add(trace_color(i), 1.0 / colors);
    return sum;
  };
  return through_layers(context, camera, first, trace);
}

PathSample sample_features(const TraceContext& context, const CameraSample& camera,
                           const std::optional<Hit>& first) {
  const auto trace = [&](const Ray& rest, const std::optional<Hit>& hit, std::uint32_t /*layer*/) {
    PathSample sample;
    ++sample.rays;
    if (hit) {
      const Surface surface = surface_at(context.scene, *hit, rest);
      sample.features = features_of(surface.material, surface.frame.normal, hit->distance,
                                    context.scene.meshes[hit->mesh].material);
      sample.emitted = emitted(surface.material, surface.frame.to_local(-rest.direction));
      sample.alpha = 1;
    } else {
      sample.background = background(context, rest.direction, camera.point);
    }
    return sample;
  };
  return through_layers(context, camera, first, trace);
}

}  // namespace gltfx::render
