// SPDX-License-Identifier: Apache-2.0
/// What is wanted of the points in a volume.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>

#include "model/point_blocks.hpp"
#include "model/shape.hpp"

namespace gltfx::model {

/// The length of a vector.
inline double norm(const Vector3& of) { return std::hypot(of[0], of[1], of[2]); }

/// The corner of a box that is farthest from 0.
inline Vector3 far_corner(const Box& box) {
  Vector3 far{};
  for (std::size_t k = 0; k < 3; ++k) {
    far[k] = std::max(std::abs(box.least[k]), std::abs(box.greatest[k]));
  }
  return far;
}

/// Finds the point that is farthest outside of a volume.
class MissWatcher final : public PointWatcher {
 public:
  /// `most`: points are found beyond that distance.
  MissWatcher(const BoundingVolume& volume, double most) : volume_(volume), most_(most) {}

  bool wants(const Box& box) const override { return volume_.distance(far_corner(box)) > most_; }
  void take(const Vector3& point, std::size_t index) override {
    const double distance = volume_.distance(point);
    if (!(distance > most_)) return;
    most_ = distance;
    found_ = index;
    reach_ = norm(point) + norm(volume_.center);
  }

  const std::optional<std::size_t>& found() const { return found_; }
  double most() const { return most_; }
  double reach() const { return reach_; }

 private:
  const BoundingVolume& volume_;
  double most_;
  double reach_ = 0;
  std::optional<std::size_t> found_;
};

/// The box of all points.
class ExtentWatcher final : public PointWatcher {
 public:
  bool wants(const Box& box) const override {
    for (std::size_t k = 0; k < 3; ++k) {
      if (box.least[k] < all_.least[k] || box.greatest[k] > all_.greatest[k]) return true;
    }
    return false;
  }
  void take(const Vector3& point, std::size_t) override { all_.add(point); }
  const Box& all() const { return all_; }

 private:
  Box all_;
};

}  // namespace gltfx::model
