// SPDX-License-Identifier: Apache-2.0
#include "model/surface_distance.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>

#include "base/parallel.hpp"

namespace gltfx::model {
namespace {

// Corners, midpoints and the center of a triangle, as weights of its corners.
constexpr std::array<Vector3, 7> kSamples{{{1, 0, 0},
                                           {0, 1, 0},
                                           {0, 0, 1},
                                           {0.5, 0.5, 0},
                                           {0, 0.5, 0.5},
                                           {0.5, 0, 0.5},
                                           {1 / 3.0, 1 / 3.0, 1 / 3.0}}};

// One direction, for triangles [first, last).
SurfaceDistance farthest(const Surface& from, const SurfaceTree& to, std::size_t first,
                         std::size_t last, double most) {
  constexpr std::uint64_t kMostWork = 256;  // boxes for a sample, in the mean
  SurfaceDistance found;
  std::uint32_t hint = 0;
  std::uint64_t work = 0;
  const std::uint64_t most_work = kMostWork * kSamples.size() * (last - first);
  for (std::size_t i = first; i < last && found.distance <= most; ++i) {
    const Vector3 a = from.corner(3 * i), b = from.corner(3 * i + 1), c = from.corner(3 * i + 2);
    for (const Vector3& weights : kSamples) {
      Vector3 point{};
      for (std::size_t k = 0; k < 3; ++k)
        point[k] = weights[0] * a[k] + weights[1] * b[k] + weights[2] * c[k];
      const auto nearest = to.nearest(point, found.distance, hint);
      hint = nearest.triangle;
      work += nearest.work;
      if (work > most_work) return {std::numeric_limits<double>::infinity(), point};
      if (nearest.distance > found.distance) found = {nearest.distance, point};
    }
  }
  return found;
}

SurfaceDistance farthest(const Surface& from, const SurfaceTree& to, double most, unsigned jobs) {
  constexpr std::size_t kChunk = 4096;
  SurfaceDistance found;
  const std::size_t count = (from.triangles() + kChunk - 1) / kChunk;
  std::vector<SurfaceDistance> chunks(count);
  std::atomic<bool> is_tangled{false};
  parallel_ordered(
      count, jobs,
      [&](std::size_t i) {
        if (is_tangled) return;
        chunks[i] =
            farthest(from, to, i * kChunk, std::min((i + 1) * kChunk, from.triangles()), most);
        if (std::isinf(chunks[i].distance)) is_tangled = true;
      },
      [&](std::size_t i) {
        if (chunks[i].distance > found.distance) found = chunks[i];
      });
  if (is_tangled) found.distance = std::numeric_limits<double>::infinity();
  return found;
}

}  // namespace

SurfaceDistance surface_distance(const SurfaceTree& one, const SurfaceTree& other, double most,
                                 unsigned jobs) {
  const bool here = one.surface().triangles() > 0, there = other.surface().triangles() > 0;
  if (!here || !there) return {here == there ? 0 : std::numeric_limits<double>::infinity(), {}};
  // The smaller surface first: it is the faster one to refuse.
  const SurfaceDistance back = farthest(other.surface(), one, most, jobs);
  if (back.distance > most) return back;
  const SurfaceDistance forth = farthest(one.surface(), other, most, jobs);
  return forth.distance > back.distance ? forth : back;
}

}  // namespace gltfx::model
