// SPDX-License-Identifier: Apache-2.0
#include "model/surface_distance.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>

#include "base/parallel.hpp"

namespace gltfx::model {
namespace {

// Points of a triangle in even steps, as weights of its corners: corners, points of the edges, and
// points inside. With 6 steps these include the midpoints of edges and the center.
std::vector<Vector3> even_points(unsigned steps) {
  std::vector<Vector3> points;
  for (unsigned i = 0; i <= steps; ++i) {
    for (unsigned k = 0; i + k <= steps; ++k) {
      const double a = 1.0 * i / steps, b = 1.0 * k / steps;
      points.push_back({a, b, 1.0 * (steps - i - k) / steps});
    }
  }
  return points;
}

// One direction, for triangles [first, last).
SurfaceDistance farthest(const Surface& from, const SurfaceTree& to, std::size_t first,
                         std::size_t last, const std::vector<Vector3>& samples, double most) {
  constexpr std::uint64_t kMostWork = 256;  // boxes for a sample, in the mean
  SurfaceDistance found;
  std::uint32_t hint = 0;
  std::uint64_t work = 0;
  const std::uint64_t most_work = kMostWork * samples.size() * (last - first);
  for (std::size_t i = first; i < last && found.distance <= most; ++i) {
    const Vector3 a = from.corner(3 * i), b = from.corner(3 * i + 1), c = from.corner(3 * i + 2);
    for (const Vector3& weights : samples) {
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
  // Between the samples of a large triangle the other surface may be farther away.
  constexpr unsigned kFine = 6, kCoarse = 3;
  const bool is_coarse = from.triangles() > 2 * to.surface().triangles();
  const std::vector<Vector3> samples = even_points(is_coarse ? kCoarse : kFine);
  constexpr std::size_t kChunk = 4096;
  SurfaceDistance found;
  const std::size_t count = (from.triangles() + kChunk - 1) / kChunk;
  std::vector<SurfaceDistance> chunks(count);
  std::atomic<bool> is_tangled{false};
  parallel_ordered(
      count, jobs,
      [&](std::size_t i) {
        if (is_tangled) return;
        chunks[i] = farthest(from, to, i * kChunk, std::min((i + 1) * kChunk, from.triangles()),
                             samples, most);
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
