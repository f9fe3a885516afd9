// SPDX-License-Identifier: Apache-2.0
#include "render/feature_recorder.hpp"

namespace gltfx::render {
namespace {

Rgb specular_albedo(const Material& m) { return m.base_color * m.metallic + Rgb(1 - m.metallic); }

}  // namespace

void Features::add(const Features& other, double weight) {
  albedo += other.albedo * weight;
  specular_albedo += other.specular_albedo * weight;
  normal += other.normal * weight;
  depth += other.depth * weight;
  if (material == kNone) material = other.material;
  clear = clear || other.clear;
}

Features features_of(const Material& m, const Vec3d& normal, double depth, std::uint32_t material) {
  return {scattering_color(m), specular_albedo(m), normal, depth, material, may_be_clear(m)};
}

void FeatureRecorder::record_first(const Scene& scene, const Hit& hit, const Surface& surface) {
  features_.specular_albedo = specular_albedo(surface.material);
  features_.material = scene.meshes[hit.mesh].material;
}

void FeatureRecorder::record(const PathState& path, const Rgb& albedo, const Vec3d& normal,
                             double distance) {
  if (recorded_) return;
  recorded_ = true;
  features_.albedo = path.throughput * albedo;
  features_.normal = normal * path.weight;
  features_.depth = (length_ + distance) * path.weight;
  features_.clear = features_.clear || path.depth > 1;
}

void FeatureRecorder::record(const PathState& path, const Hit& hit, const Surface& surface) {
  record(path, scattering_color(surface.material), surface.frame.normal, hit.distance);
}

void FeatureRecorder::go_on(const PathState& path, double distance) {
  length_ += distance;
  features_.clear = features_.clear || path.prefix.straight;
}

FeatureRecorder FeatureRecorder::split(bool records) const {
  FeatureRecorder branch(*this);
  branch.features_ = {};
  branch.recorded_ = recorded_ || !records;
  return branch;
}

}  // namespace gltfx::render
