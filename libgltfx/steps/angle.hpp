// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <numbers>

#include "model/node.hpp"

namespace gltfx::steps {

/// Between two directions of any length, in degrees; 0 if one of them has no length.
inline double angle_between(const model::Vector3& a, const model::Vector3& b) {
  const model::Vector3 across = model::cross(a, b);
  const double sine = std::sqrt(model::dot(across, across)), cosine = model::dot(a, b);
  return sine == 0 && cosine == 0 ? 0 : std::atan2(sine, cosine) * 180 / std::numbers::pi;
}

}  // namespace gltfx::steps
