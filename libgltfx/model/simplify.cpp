// SPDX-License-Identifier: Apache-2.0
#include "model/simplify.hpp"

#include <algorithm>

#include <meshoptimizer.h>

namespace gltfx::model {

std::vector<std::uint32_t> simplify(const SimplifyRequest& request) {
  const Surface& surface = request.surface;
  std::vector<std::uint32_t> corners(surface.corners.size());
  if (corners.empty()) return corners;
  const float* const positions = surface.points.front().data();
  const double scale = static_cast<double>(
      meshopt_simplifyScale(positions, surface.points.size(), sizeof(surface.points.front())));
  const double error = scale > 0 ? std::min(request.error / scale, 1e3) : 0;
  corners.resize(meshopt_simplify(corners.data(), surface.corners.data(), surface.corners.size(),
                                  positions, surface.points.size(), sizeof(surface.points.front()),
                                  3 * request.triangles, static_cast<float>(error),
                                  request.lock_borders ? meshopt_SimplifyLockBorder : 0, nullptr));
  return corners;
}

bool is_affordable(const Surface& surface, std::span<const std::uint32_t> points) {
  constexpr std::uint64_t kMost = 256;  // a mean of this many triangles for each corner
  std::vector<std::uint32_t> triangles(surface.points.size(), 0);
  for (const std::uint32_t corner : surface.corners) ++triangles[points[corner]];
  std::uint64_t work = 0;
  for (const std::uint64_t each : triangles) work += each * each;
  return work <= kMost * surface.corners.size();
}

std::vector<std::array<std::uint32_t, 2>> open_edges(std::span<const std::uint32_t> corners,
                                                     std::span<const std::uint32_t> points) {
  struct Edge {
    std::array<std::uint32_t, 2> ends;  // sorted
    bool forth;
  };
  std::vector<Edge> edges;
  edges.reserve(corners.size());
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const std::uint32_t from = points[corners[i]];
    const std::uint32_t to = points[corners[i % 3 == 2 ? i - 2 : i + 1]];
    if (from != to) edges.push_back({{std::min(from, to), std::max(from, to)}, from < to});
  }
  std::sort(edges.begin(), edges.end(),
            [](const Edge& a, const Edge& b) { return a.ends < b.ends; });
  std::vector<std::array<std::uint32_t, 2>> open;
  for (std::size_t i = 0; i < edges.size();) {
    std::size_t forth = 0, back = 0;
    const std::size_t first = i;
    for (; i < edges.size() && edges[i].ends == edges[first].ends; ++i)
      ++(edges[i].forth ? forth : back);
    if (forth != back) open.push_back(edges[first].ends);
  }
  return open;
}

}  // namespace gltfx::model
