// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "prove/column.hpp"
#include "prove/soup_pair.hpp"

namespace gltfx::prove {
namespace {

using model::SemanticKind;

constexpr double kNoAngle = std::numeric_limits<double>::infinity();

double angle_of(const double* a, const double* b) {
  const model::Vector3 p{a[0], a[1], a[2]};
  const model::Vector3 q{b[0], b[1], b[2]};
  const bool turns = model::dot(p, p) > 0;
  if (turns != (model::dot(q, q) > 0)) return kNoAngle;
  const model::Vector3 across = model::cross(p, q);
  const double degrees =
      std::atan2(std::sqrt(model::dot(across, across)), model::dot(p, q)) * 180 / std::numbers::pi;
  if (std::isnan(degrees)) return kNoAngle;
  // If only the lengths differ, the vectors are not equal.
  return degrees > 0 ? degrees : std::numeric_limits<double>::min();
}

// Pairs (joint, weight), sorted by joint; padding has weight 0.
double influence_distance(const double* a, const double* b, unsigned width) {
  double greatest = 0;
  unsigned i = 0;
  unsigned k = 0;
  const auto ends = [width](const double* list, unsigned at) {
    return at >= width || list[at + 1] == 0;
  };
  while (!ends(a, i) || !ends(b, k)) {
    const bool only_a = ends(b, k) || (!ends(a, i) && a[i] < b[k]);
    const bool only_b = ends(a, i) || (!ends(b, k) && b[k] < a[i]);
    const double weight = only_a   ? apart(a[i + 1], 0)
                          : only_b ? apart(b[k + 1], 0)
                                   : apart(a[i + 1], b[k + 1]);
    greatest = std::max(greatest, weight);
    if (!only_b) i += 2;
    if (!only_a) k += 2;
  }
  return greatest;
}

}  // namespace

double stream_distance(const SoupStream& stream, const double* a, const double* b,
                       const SoupScale& scale) {
  a += stream.offset;
  b += stream.offset;
  double greatest = 0;
  for (unsigned i = 0; i < stream.width; ++i) greatest = std::max(greatest, apart(a[i], b[i]));
  if (greatest == 0) return 0;
  const bool direction =
      stream.kind == SemanticKind::normal || stream.kind == SemanticKind::tangent;
  if (stream.kind == SemanticKind::weights) {
    return stream.joints == json::kNoNode ? greatest : influence_distance(a, b, stream.width);
  }
  if (stream.width >= 3 && direction && !stream.of_target) {
    if (stream.width > 3 && apart(a[3], b[3]) > 0) return kNoAngle;
    return angle_of(a, b);
  }
  if (stream.width == 3 && (direction || stream.kind == SemanticKind::position)) {
    double square = 0;
    for (unsigned i = 0; i < 3; ++i) square += std::pow(apart(a[i], b[i]), 2);
    const double length = std::sqrt(square);
    return direction ? length * 180 / std::numbers::pi : length;
  }
  return stream.kind == SemanticKind::texcoord ? greatest * scale.texels : greatest;
}

}  // namespace gltfx::prove
