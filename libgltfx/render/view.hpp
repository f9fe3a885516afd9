// SPDX-License-Identifier: Apache-2.0
/// Cameras: from points and pixels of a picture to rays.
#pragma once

#include <gltfx/vec3.hpp>

#include <array>
#include <cmath>
#include <cstdint>
#include <span>

#include "base/lanes.hpp"
#include "render/ray.hpp"
#include "render/sampler.hpp"
#include "render/scene.hpp"

namespace gltfx::render {

/// A camera with the shape of its picture.
struct View {
  Vec3d origin{0, 0, 1};
  Vec3d right{1, 0, 0}, up{0, 1, 0}, backward{0, 0, 1};  ///< orthonormal
  bool perspective = true;
  /// Half the extent of the picture: at distance 1, or everywhere for an orthographic camera.
  double half_width = 0.5, half_height = 0.5;
  /// The camera is inside a room: light comes in through its walls.
  bool inside = false;

  /// The ray through a point of the picture: x and y from 0 to 1, from the upper left.
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

/// The samples of one pixel in a picture of width x height pixels. Positions are distributed by a
/// tent filter two pixels wide: edges are smooth, and samples of different pixels stay independent.
class PixelSamples {
 public:
  PixelSamples(std::uint32_t width, std::uint32_t height, std::uint32_t seed, std::uint32_t x,
               std::uint32_t y)
      : random_(seed, y * width + x, 0), width_(width), height_(height), x_(x + 0.5), y_(y + 0.5) {}

  /// Samples from number `first` on.
  void fill(const View& view, std::uint32_t first, std::span<CameraSample> samples) const {
    CameraSample* sample = samples.data();
    const auto last = first + static_cast<std::uint32_t>(samples.size());
    visit(first, last, [&](std::uint32_t number, double x, double y) {
      *sample++ = {view.ray(x, y), to_float2(x, y), random_.later(number)};
    });
  }

  /// Calls visit(point) for the points of the picture of the samples [first, last).
  template <class Visit>
  void visit_points(std::uint32_t first, std::uint32_t last, const Visit& visit_point) const {
    visit(first, last, [&](std::uint32_t, double x, double y) { visit_point(to_float2(x, y)); });
  }

 private:
  static Float2 to_float2(double x, double y) {
    return {static_cast<float>(x), static_cast<float>(y)};
  }

  template <class Visit>
  void visit(std::uint32_t first, std::uint32_t last, const Visit& visit_sample) const {
    while (first < last) {
      for (const Float2& jitter : random_.later(first).following_pairs(0)) {
        visit_sample(first, (x_ + tent(jitter[0])) / width_, (y_ + tent(jitter[1])) / height_);
        if (++first == last) break;
      }
    }
  }

  static double tent(float uniform) {
    const double r = static_cast<double>(uniform) * 2;
    const double inwards = 1 - std::sqrt(r < 1 ? r : 2 - r);
    return r < 1 ? -inwards : inwards;
  }

  SampleStream random_;
  double width_, height_;
  double x_, y_;  // of the middle
};

}  // namespace gltfx::render
