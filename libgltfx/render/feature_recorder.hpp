// SPDX-License-Identifier: Apache-2.0
/// Features of a picture (PathSample::features), recorded along paths.
#pragma once

#include "render/integrator.hpp"
#include "render/path.hpp"
#include "render/surface.hpp"

namespace gltfx::render {

/// Features of a surface alone, without those seen through it. `material`: index in the scene, or
/// kNone.
Features features_of(const Material& m, const Vec3d& normal, double depth, std::uint32_t material);

/// Material and specular albedo are those of the first surface; albedo, normal and depth those of
/// the first vertex that is not clear glass, filtered by the glass before it.
class FeatureRecorder {
 public:
  void record_first(const Scene& scene, const Hit& hit, const Surface& surface);
  /// A vertex that the path has reached and not left yet, at a distance from the previous one. Only
  /// the first one counts.
  void record(const PathState& path, const Rgb& albedo, const Vec3d& normal, double distance);
  void record(const PathState& path, const Hit& hit, const Surface& surface);
  /// Call it when the path has left a surface, which it reached after `distance`.
  void go_on(const PathState& path, double distance);

  /// The recorder of a branch, without the features that the path before it has recorded.
  FeatureRecorder split(bool records) const;

  const Features& features() const { return features_; }

 private:
  Features features_;
  double length_ = 0;  // to the last surface
  bool recorded_ = false;
};

}  // namespace gltfx::render
