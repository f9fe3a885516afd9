// SPDX-License-Identifier: Apache-2.0
/// Cameras: from points and pixels of a picture to rays.
#pragma once

#include <gltfx/vec3.hpp>

#include <array>
#include <cmath>
#include <cstdint>

#include "bake/ray.hpp"
#include "bake/sampler.hpp"
#include "bake/scene.hpp"

namespace gltfx::bake {

/// A camera with a picture of a certain shape before it.
struct View {
  Vec3d origin{0, 0, 1};
  Vec3d right{1, 0, 0}, up{0, 1, 0}, backward{0, 0, 1};  ///< orthonormal
  bool perspective = true;
  /// Half the extent of the picture: at distance 1, or everywhere for an orthographic camera.
  double half_width = 0.5, half_height = 0.5;
  /// Of a room around the camera: light comes in through its walls.
  bool inside = false;

  /// Through a point of the picture: x and y from 0 to 1, from the upper left.
  Ray ray(double x, double y) const;
};

/// The view of a camera of the asset. `aspect`: width by height of the picture. A picture of
/// another aspect than the camera's shows more, never less.
View view_of(const Camera& camera, double aspect);

struct CameraSample {
  Ray ray;
  Float2 point{};  ///< of the picture, x and y from 0 to 1
  SampleStream random{};
};

/// The point of the picture of a sample in width x height pixels. Positions are distributed by a
/// tent filter two pixels wide: edges are smooth, and samples of different pixels stay independent.
inline std::array<double, 2> camera_point(std::uint32_t width, std::uint32_t height,
                                          std::uint32_t x, std::uint32_t y,
                                          const SampleStream& random) {
  const auto tent = [](float uniform) {
    const double r = static_cast<double>(uniform) * 2;
    return r < 1 ? std::sqrt(r) - 1 : 1 - std::sqrt(2 - r);
  };
  const Float2 jitter = random.pair(0);
  return {(x + 0.5 + tent(jitter[0])) / width, (y + 0.5 + tent(jitter[1])) / height};
}

/// The ray of a sample through its point.
inline CameraSample camera_sample(const View& view, std::uint32_t width, std::uint32_t height,
                                  std::uint32_t seed, std::uint32_t x, std::uint32_t y,
                                  std::uint32_t sample) {
  const SampleStream random(seed, y * width + x, sample);
  const auto [px, py] = camera_point(width, height, x, y, random);
  return {view.ray(px, py), {static_cast<float>(px), static_cast<float>(py)}, random};
}

}  // namespace gltfx::bake
