// SPDX-License-Identifier: Apache-2.0
/// The texture of a smooth surface within a pixel, sampled without rays.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "render/integrator.hpp"
#include "render/ray.hpp"
#include "render/scene.hpp"

namespace gltfx::render {

/// If one smooth surface fills a pixel, its texture coordinates are an affine function of the point
/// of the picture. A few rays determine it.
class PixelSurface {
 public:
  static constexpr std::uint32_t kRays = 8;

  /// The scene must outlive it.
  explicit PixelSurface(const Scene& scene) : scene_(scene) {}

  /// A feature sample, by a ray through `point` of the picture. After more than kRays samples,
  /// fit() fails.
  void add(const Float2& point, const std::optional<Hit>& hit, const PathSample& sample);
  /// Finds the function by least squares. False if the rays hit several bodies or none, if the
  /// surface has more than two sets of texture coordinates or none, holes, emission, or vertex
  /// colours, or if coordinates differ from the function by a seventh of a pixel.
  bool fit();

  /// A feature sample at a point of the picture. Precondition: fit() was true.
  PathSample at(const Float2& point) const;

 private:
  static constexpr std::size_t kMostSets = 2;
  struct SeenPoint {
    Float2 point;
    Hit hit;
  };
  /// One texture coordinate by the point of the picture, relative to the middle.
  struct Affine {
    double middle = 0, along_x = 0, along_y = 0;
  };
  using Coordinates = std::array<Affine, 2>;  // u and v

  bool fit(std::size_t set);
  Vec3d from_middle(const Float2& point) const;
  Float2 uv_at(std::size_t set, const Float2& point) const;

  const Scene& scene_;
  std::uint32_t count_ = 0;
  bool missed_ = false;
  std::array<SeenPoint, kRays> seen_;
  // Means of kRays of them:
  Vec3d middle_;  ///< of the points; z is 0
  Vec3d normal_;
  double depth_ = 0;
  std::array<Coordinates, kMostSets> sets_{};
};

}  // namespace gltfx::render
