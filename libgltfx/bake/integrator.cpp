// SPDX-License-Identifier: Apache-2.0
#include "bake/integrator.hpp"

#include <optional>

#include "bake/coverage.hpp"
#include "bake/path.hpp"
#include "bake/storage.hpp"

namespace gltfx::bake {
namespace {

constexpr std::uint32_t kLayers = 4;  // of alpha, before the camera
constexpr double kLeast = 1.0 / 512;  // of a layer

// With dispersion each colour is a picture of its own.
std::uint32_t colors_at(const Scene& scene, const Hit& hit) {
  const Material& factors = material_of(scene, scene.meshes[hit.mesh]).factors;
  return factors.dispersion > 0 && factors.transmission > 0 ? 3 : 1;
}

// What is partly transparent by alpha is not left to chance where it is seen directly: each layer
// is a path of its own, and counts for what it covers of what is left.
template <class Trace>
PathSample through_layers(const PathSetting& setting, const Ray& ray, const SampleStream& random,
                          const Trace& trace) {
  PathSample sum;
  Ray rest = ray;
  double left = 1;
  for (std::uint32_t layer = 0;; ++layer) {
    const bool last = layer + 1 == kLayers;
    const auto hit =
        last ? setting.bvh.intersect(rest, random.key()) : setting.bvh.first_layer(rest);
    const double covered = hit && !last ? static_cast<double>(setting.bvh.coverage(*hit)) : 1.0;
    ++sum.rays;
    trace(sum, rest, hit, layer, left * covered);
    left *= 1 - covered;
    if (left < kLeast) return sum;
    const Vec3d behind = rest.origin + rest.direction * hit->distance;
    rest.origin = beside(behind, rest.direction, setting.size);
  }
}

}  // namespace

void PathSample::add(const PathSample& path, double part) {
  scattered += path.scattered * part;
  reflected += path.reflected * part;
  direct += path.direct * part;
  const double seen = luminance(path.behind) * part;
  if (seen > 0) {
    const double before = luminance(behind);
    shadow = (shadow * before + path.shadow * seen) / (before + seen);
    behind += path.behind * part;
  }
  alpha += path.alpha * part;
  albedo += path.albedo * part;
  mirror += path.mirror * part;
  normal += path.normal * part;
  depth += path.depth * part;
  if (material == kNone) material = path.material;
  clear = clear || path.clear;
  rays += path.rays;
}

PathSample trace_path(const PathSetting& setting, const Ray& ray, const Float2& point,
                      const SampleStream& random) {
  const auto trace = [&](PathSample& sum, const Ray& rest, const std::optional<Hit>& hit,
                         std::uint32_t layer, double share) {
    const std::uint32_t colors = hit ? colors_at(setting.scene, *hit) : 1;
    for (std::uint32_t i = 0; i < colors; ++i) {
      const PathSample path = follow_path(setting, rest, point, random, {hit, layer, {i, colors}});
      sum.add(path, share / colors);
    }
  };
  return through_layers(setting, ray, random, trace);
}

PathSample look_along(const PathSetting& setting, const Ray& ray, const Float2& point,
                      const SampleStream& random) {
  const auto look = [&](PathSample& sum, const Ray& rest, const std::optional<Hit>& hit,
                        std::uint32_t layer, double share) {
    sum.add(look_at_start(setting, rest, point, random, {hit, layer, {}}), share);
  };
  return through_layers(setting, ray, random, look);
}

}  // namespace gltfx::bake
