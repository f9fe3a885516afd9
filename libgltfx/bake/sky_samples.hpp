// SPDX-License-Identifier: Apache-2.0
/// Samples of the environment that are made once for a picture, so that a surface can choose among
/// many of them in the time that one of its own would take.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "bake/environment.hpp"
#include "bake/storage.hpp"

namespace gltfx::bake {

/// The density with which SkySamples::choose() finds directions from a surface: in proportion to
/// their luminance times the cosine. For multiple importance sampling, where a density that is not
/// exact costs noise but no light.
struct SkyPdf {
  Vec3d normal;
  double scale = 0;  ///< number of choices over the irradiance; 0: by Environment::sample()

  /// Of radiance from a direction; `pdf`: that of Environment::sample().
  double operator()(const Vec3d& direction, const Rgb& radiance, double pdf) const {
    return scale > 0 ? luminance(radiance) * std::fabs(dot(direction, normal)) * scale : pdf;
  }
};

/// Blocks of directions, sampled by brightness. Each block is stratified, and so are the blocks
/// that follow each other. All surfaces of a picture share the directions: they are so many that
/// the error is below that of 8 bits, and it does not become less with more samples.
class SkySamples {
 public:
  explicit SkySamples(const Environment& environment);

  /// Chooses one direction of a block in proportion to its brightness times the cosine to a normal
  /// (resampled importance sampling), on the side of the normal or, with `both`, on both sides.
  /// `random` is uniform: the first number chooses the block, the second the direction.
  EnvironmentSample choose(const Vec3d& normal, bool both, const Float2& random) const;

  /// The density of `count` choices.
  SkyPdf pdf(const Vec3d& normal, bool both, std::uint32_t count) const;

  /// The unoccluded irradiance of a surface, to a few percent: by spherical harmonics of the second
  /// degree (R. Ramamoorthi and P. Hanrahan, An Efficient Representation for Irradiance Environment
  /// Maps, 2001).
  Rgb irradiance(const Vec3d& normal) const;

 private:
  static constexpr std::size_t kLanes = 4;  // that are computed together
  static constexpr std::size_t kBlock = 16;
  using Numbers = std::array<float, kBlock>;

  struct Block {
    Numbers x, y, z;
    Numbers brightness;  ///< luminance over density
  };
  struct Light {
    Float3 radiance;
    float pdf;
  };

  std::vector<Block> blocks_;
  std::vector<Light> lights_;       ///< of all blocks, one after the other
  std::array<Rgb, 9> harmonics_{};  ///< of the irradiance
};

}  // namespace gltfx::bake
