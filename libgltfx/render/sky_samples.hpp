// SPDX-License-Identifier: Apache-2.0
/// Samples of the environment that are made once for a picture, so that a surface can choose among
/// many of them in the time of one new sample.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "base/lanes.hpp"
#include "base/packed.hpp"
#include "render/environment.hpp"

namespace gltfx::render {

/// The properties of a surface that light sampling depends on.
struct Receiver {
  Vec3d normal;
  double behind = 0;  ///< importance of light from behind, from 0 (opaque) to 1

  /// The importance of light from a direction.
  double weight(const Vec3d& direction) const {
    const double cosine = dot(direction, normal);
    return cosine > 0 ? cosine * (1 - behind) : -cosine * behind;
  }
};

/// The density with which SkySamples::choose() finds directions: in proportion to their luminance
/// times their weight. For multiple importance sampling, where an inexact density adds noise but no
/// bias.
struct SkyPdf {
  Receiver receiver;
  double scale = 0;  ///< number of choices over the weighted irradiance; 0: not known

  explicit operator bool() const { return scale > 0; }
  /// Per steradian, of radiance from a direction.
  double operator()(const Vec3d& direction, const Rgb& radiance) const {
    return luminance(radiance) * receiver.weight(direction) * scale;
  }
};

/// Blocks of directions, sampled by brightness. Each has one direction of each of 16 parts of the
/// sky, and from block to block they move through their parts, so that stratified numbers choose
/// distant directions. All surfaces of a picture share the directions, which are many more than a
/// pixel has samples: their error is below that of 8 bits, and it falls with more samples.
class SkySamples {
 public:
  /// `samples`: of a pixel.
  SkySamples(const Environment& environment, std::uint32_t samples);

  /// Chooses one direction of a block in proportion to its brightness times its weight (resampled
  /// importance sampling). `random` is uniform: the first number chooses the block, the second the
  /// direction.
  EnvironmentSample choose(const Receiver& receiver, const Float2& random) const;

  /// The density of `count` choices.
  SkyPdf pdf(const Receiver& receiver, std::uint32_t count) const;

  /// The unoccluded irradiance of a surface, to a few percent: by spherical harmonics of the second
  /// degree (R. Ramamoorthi and P. Hanrahan, An Efficient Representation for Irradiance Environment
  /// Maps, 2001).
  Rgb irradiance(const Vec3d& normal) const;

 private:
  static constexpr std::size_t kBlock = 4 * kLanes;
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
  std::vector<Light> lights_;           ///< of all blocks, one after the other
  std::array<Rgb, 9> harmonics_{};      ///< of the irradiance
  std::array<double, 9> luminances_{};  ///< of harmonics_
};

}  // namespace gltfx::render
