// SPDX-License-Identifier: Apache-2.0
#include "preview/view_choice.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <unordered_map>
#include <vector>

namespace gltfx::preview {
namespace {

constexpr std::size_t kFewThings = 6;
constexpr int kRaysAlong = 32;  // across and down a picture
constexpr int kFineRaysAlong = 64;

// What is seen in a picture.
struct Shown {
  std::size_t things = 0;
  /// The sum over all things of the square root of their part of the picture: more of them are
  /// better, and larger ones.
  double worth = 0;
};

Shown shown_from(const Subject& subject, const render::Bvh& bvh, const Direction& direction,
                 int along = kRaysAlong) {
  const render::View view = frame(subject, direction, 1);
  std::unordered_map<std::uint64_t, int> seen;
  for (int y = 0; y < along; ++y) {
    for (int x = 0; x < along; ++x) {
      const auto hit = bvh.intersect(view.ray((x + 0.5) / along, (y + 0.5) / along), 0);
      if (hit) ++seen[hit->body()];
    }
  }
  std::vector<int> rays;  // in an order of their own: sums of floating point depend on it
  for (const auto& [body, count] : seen) rays.push_back(count);
  std::sort(rays.begin(), rays.end());
  Shown shown;
  for (const int count : rays) {
    shown.things += count > 1 ? 1 : 0;  // more than a speck
    shown.worth += std::sqrt(static_cast<double>(count));
  }
  return shown;
}

std::size_t count_things(const render::Scene& scene) {
  std::size_t things = 0;
  for (const render::Instance& instance : scene.instances) things += instance.count;
  return things;
}

struct Candidate {
  Direction direction;
  double worth;   // the least for which it is taken, in those of the usual view
  double things;  // likewise
};

std::vector<Candidate> candidates_for(const Subject& subject, const Direction& usual) {
  constexpr double kThin = 0.25;
  const Vec3d extent = subject.greatest - subject.least;
  std::vector<Candidate> candidates;
  if (extent.z < kThin * std::min(extent.x, extent.y)) candidates.push_back({{8, 6}, 0.9, 1});
  if (extent.x < kThin * std::min(extent.y, extent.z)) candidates.push_back({{82, 6}, 0.9, 1});
  if (usual.elevation > 0 && usual.elevation < 30) {
    candidates.push_back({{usual.azimuth, 45}, 1.4, 1.25});
  }
  return candidates;
}

// Whether a wide hall shows little but its ceiling to the usual view. Things in it are small.
bool hides_below_ceiling(const Subject& subject, const render::Bvh& bvh, const Direction& usual,
                         const Direction& low) {
  constexpr std::size_t kMoreThings = 2;
  constexpr double kMoreWorth = 1.1;
  if (usual.elevation <= low.elevation) return false;
  const Shown above = shown_from(subject, bvh, usual, kFineRaysAlong);
  const Shown below = shown_from(subject, bvh, low, kFineRaysAlong);
  return below.things >= kMoreThings * above.things && below.worth >= kMoreWorth * above.worth;
}

}  // namespace

Direction best_direction(const render::Scene& scene, const Subject& subject,
                         const render::Bvh& bvh) {
  const Direction usual = usual_direction(subject);
  const std::size_t all = count_things(scene);
  if (all < kFewThings) return usual;
  const Shown today = shown_from(subject, bvh, usual);
  for (const Candidate& each : candidates_for(subject, usual)) {
    const Shown shown = shown_from(subject, bvh, each.direction);
    const auto things = static_cast<double>(shown.things);
    if (shown.worth >= each.worth * today.worth &&
        things >= each.things * static_cast<double>(today.things)) {
      return each.direction;
    }
  }
  const Direction low{usual.azimuth, 5};
  const bool few = 2 * today.things <= all;
  return few && hides_below_ceiling(subject, bvh, usual, low) ? low : usual;
}

}  // namespace gltfx::preview
