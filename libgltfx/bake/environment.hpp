// SPDX-License-Identifier: Apache-2.0
/// Light from far away, by direction.
#pragma once

#include <gltfx/vec3.hpp>

#include <cstdint>
#include <vector>

#include "bake/distribution.hpp"
#include "bake/scene.hpp"

namespace gltfx::bake {

/// A direction that light comes from, and how likely it was.
struct EnvironmentSample {
  Vec3d direction;
  Float2 point{};  ///< of the image
  double pdf = 0;  ///< per steradian; 0: no sample
};

/// What is seen in a direction.
struct EnvironmentValue {
  Rgb radiance;
  double pdf = 0;  ///< with which sample() takes the direction
};

/// An equirectangular image that is read between its texels, and sampled by its brightness.
class Environment {
 public:
  /// `image` has at least one texel.
  explicit Environment(const EnvironmentImage& image);

  Rgb radiance(const Vec3d& direction) const { return evaluate(direction).radiance; }
  /// Radiance and density of a direction in one go.
  EnvironmentValue evaluate(const Vec3d& direction) const;
  EnvironmentSample sample(const Float2& random) const;
  /// That of a sample.
  Rgb radiance(const EnvironmentSample& sample) const { return radiance_at(sample.point); }
  Rgb radiance_at(const Float2& point) const;
  /// Of sample(), per steradian.
  double pdf(const Vec3d& direction) const { return evaluate(direction).pdf; }

 private:
  std::uint32_t width_, height_;
  std::vector<Float3> texels_;  ///< rows from the top, with a border that makes it endless
  GridDistribution distribution_;
};

/// The direction at a point of the unit square over the image, and the other way round.
Vec3d direction_of(const Float2& point);
Float2 point_of(const Vec3d& direction);

}  // namespace gltfx::bake
