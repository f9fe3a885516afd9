// SPDX-License-Identifier: Apache-2.0
/// Light from infinity, by direction.
#pragma once

#include <gltfx/vec3.hpp>

#include <cstdint>
#include <vector>

#include "render/distribution.hpp"
#include "render/scene.hpp"

namespace gltfx::render {

/// A sampled direction.
struct EnvironmentSample {
  Vec3d direction;
  Rgb radiance;
  double pdf = 0;    ///< of Environment::sample(), per steradian; 0: no sample
  double scale = 0;  ///< of the radiance in an estimate: one over the density
};

/// Radiance from a direction, and its density in sample().
struct EnvironmentValue {
  Rgb radiance;
  double pdf = 0;  ///< per steradian
};

/// The direction at a point of the unit square over the image, and the other way round.
Vec3d direction_of(const Float2& point);
Float2 point_of(const Vec3d& direction);

/// An equirectangular image, interpolated linearly and sampled by its brightness.
class Environment {
 public:
  /// `image` has at least one texel.
  explicit Environment(const EnvironmentImage& image);

  Rgb radiance(const Vec3d& direction) const { return radiance_at(point_of(direction)); }
  EnvironmentValue evaluate(const Vec3d& direction) const;
  EnvironmentSample sample(const Float2& random) const;
  /// The density of sample(), per steradian.
  double pdf(const Vec3d& direction) const { return evaluate(direction).pdf; }

 private:
  Rgb radiance_at(const Float2& point) const;

  std::uint32_t width_, height_;
  std::vector<Float3> texels_;  ///< rows from the top, with a border of one texel
  PiecewiseConstant2d distribution_;
};

}  // namespace gltfx::render
