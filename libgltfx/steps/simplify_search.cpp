// SPDX-License-Identifier: Apache-2.0
#include "steps/simplify_search.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "base/parallel.hpp"
#include "steps/simplify_drift.hpp"

namespace gltfx::steps {
namespace {

constexpr double kUnlimited = std::numeric_limits<double>::infinity();
constexpr const char* kTears = "would get open edges";
constexpr const char* kTangled = "is too tangled to measure";
constexpr const char* kNone = "has no triangle that may go within the bound";

using Corners = std::vector<std::uint32_t>;

/// The surface before, prepared for comparisons.
class Reference {
 public:
  explicit Reference(const SimplifyJob& job)
      : job_(job), tree_(job.surface()), open_(model::open_edges(job.corners, job.same)) {}

  bool is_open() const { return !open_.empty(); }

  Corners simplified(double error, bool locked) const {
    return model::simplify({job_.surface(), 1, error / job_.scale, locked});
  }

  // No new holes; a closed surface stays closed, and locked borders stay as they are.
  bool is_whole(const Corners& corners, bool locked) const {
    const auto open = model::open_edges(corners, job_.same);
    return locked ? open == open_ : open.size() <= open_.size();
  }

  // Measures a result. The distance, in the unit of the error, is any greater one above `most`.
  double measure(const Corners& corners, double most, unsigned jobs, SimplifyDrift& drift) const {
    const model::SurfaceTree tree({job_.positions, corners});
    const double distance = model::surface_distance(tree_, tree, most / job_.scale, jobs).distance;
    // Rounding: the nearest point may be a little farther away than the distance of samples.
    if (job_.scale * distance <= most) drift = measure_drift(job_, tree, distance * 1.001, jobs);
    return job_.scale * distance;
  }

 private:
  const SimplifyJob& job_;
  const model::SurfaceTree tree_;
  const std::vector<std::array<std::uint32_t, 2>> open_;
};

/// Looks for the greatest estimate of the error whose result is within the bound. The estimate is
/// not the distance: it may be a third of it, or three times it.
class Search {
 public:
  Search(SimplifyJob& job, const Reference& before, double bound, bool locked, unsigned jobs)
      : job_(job), before_(before), bound_(bound), locked_(locked), jobs_(jobs) {}

  // Keeps the best result in the job; `why`: what the last attempt lacks.
  // False: it cannot be measured.
  bool run(const char*& why) {
    constexpr int kMostTries = 10;
    constexpr double kNearEnough = 0.9;
    double error = bound_ / 2, least = 0, greatest = 0;  // within the bound, and beyond it
    for (int i = 0; i < kMostTries; ++i) {
      const double part = attempt(error, why);
      if (is_tangled_) return false;
      if (part <= 1) {
        if (part >= kNearEnough || is_still_) return true;
        least = error;
      } else {
        greatest = error;
      }
      if (least > 0 && greatest > 0) {
        if (least > kNearEnough * greatest) return true;
        error = std::sqrt(least * greatest);
      } else {
        error *= std::clamp(0.95 / part, 0.2, part > 1 ? 0.7 : 4.0);
      }
    }
    return true;
  }

 private:
  // The greatest loss as a part of its bound; infinite: the result is no surface.
  double attempt(double error, const char*& why) {
    Corners corners = before_.simplified(error, locked_);
    is_still_ = std::exchange(last_, corners.size()) == corners.size();
    if (corners.size() == job_.corners.size()) return 0;  // nothing is gone, nothing is lost
    if (corners.empty() || !before_.is_whole(corners, locked_)) {
      why = kTears;
      return kUnlimited;
    }
    SimplifyDrift drift;
    const double distance = before_.measure(corners, bound_, jobs_, drift);
    const double part =
        std::max({distance / bound_, drift.slide / bound_, drift.angle / kMostAngle});
    if (part > 1) {
      is_tangled_ = std::isinf(distance);
      why = is_tangled_         ? kTangled
            : distance > bound_ ? kNone
                                : "has normals or textures that would move too far";
      return part;
    }
    if (job_.result.empty() || corners.size() < job_.result.size()) {
      job_.result = std::move(corners);
      job_.measured = distance;
      job_.drift = drift;
    }
    return part;
  }

  SimplifyJob& job_;
  const Reference& before_;
  const double bound_;
  const bool locked_;
  const unsigned jobs_;
  std::size_t last_ = 0;     ///< corners of the last result
  bool is_still_ = false;    ///< the result before had as many
  bool is_tangled_ = false;  ///< it takes too long to measure
};

std::uint64_t triangles_of(const std::vector<Corners>& all) {
  std::uint64_t corners = 0;
  for (const Corners& each : all) corners += each.size();
  return corners / 3;
}

// Runs `use` for each job, on several threads where there are several jobs.
template <class Use>
void each_job(std::vector<SimplifyJob>& all, unsigned jobs, const Use& use) {
  parallel_ordered(
      all.size(), jobs, [&](std::size_t i) { use(i); }, [](std::size_t) {});
}

}  // namespace

void simplify_within(SimplifyJob& job, double bound, unsigned jobs) {
  const Reference before(job);
  const char* why = kNone;
  // Without them, errors along borders may be the ones that end the search.
  for (const bool locked : {true, false}) {
    if (locked && !job.lock_borders && !before.is_open()) continue;
    if (!locked && job.lock_borders) continue;
    if (!Search(job, before, bound, locked, jobs).run(why)) break;
  }
  if (job.result.empty() || job.result.size() == job.corners.size()) {
    job.result = job.corners;
    job.measured = 0;
    job.drift = {};
    job.why = why;
  }
}

void simplify_to(std::vector<SimplifyJob>& all, std::uint64_t triangles, unsigned jobs) {
  constexpr int kSteps = 12;
  std::vector<Corners> now(all.size()), best;
  if (all.size() == 1) {
    const SimplifyJob& job = all.front();
    best = {model::simplify(
        {job.surface(), static_cast<std::size_t>(triangles), kUnlimited, job.lock_borders})};
  } else {
    double least = 0, greatest = 0;  // logarithms of errors that leave too many, and few enough
    for (const SimplifyJob& job : all) {
      model::Vector3 low{kUnlimited, kUnlimited, kUnlimited},
          high{-kUnlimited, -kUnlimited, -kUnlimited};
      for (std::size_t i = 0; i < job.corners.size(); ++i) {
        const model::Vector3 at = job.surface().corner(i);
        for (std::size_t k = 0; k < 3; ++k) {
          low[k] = std::min(low[k], at[k]);
          high[k] = std::max(high[k], at[k]);
        }
      }
      greatest = std::max(
          greatest, job.scale * std::hypot(high[0] - low[0], high[1] - low[1], high[2] - low[2]));
    }
    if (!(greatest > 0)) return;
    greatest = std::log(greatest);
    least = greatest - std::log(1e7);
    for (int i = 0; i < kSteps; ++i) {
      const double middle = i == 0 ? greatest : (least + greatest) / 2;
      const double error = std::exp(middle);
      each_job(all, jobs, [&](std::size_t at) {
        const SimplifyJob& job = all[at];
        now[at] = model::simplify({job.surface(), 1, error / job.scale, job.lock_borders});
      });
      const bool few = triangles_of(now) <= triangles;
      if (few || i == 0) best = now;
      if (!few && i == 0) break;  // cannot have so few
      (few ? greatest : least) = middle;
    }
  }
  const unsigned inner = all.size() == 1 ? jobs : 1;
  each_job(all, jobs, [&](std::size_t at) {
    SimplifyJob& job = all[at];
    job.result = std::move(best[at]);
    const Reference before(job);
    if (job.result.empty() || !before.is_whole(job.result, job.lock_borders)) {
      job.result = job.corners;
      job.why = kTears;
    } else {
      job.measured = before.measure(job.result, kUnlimited, inner, job.drift);
      if (std::isfinite(job.measured)) return;
      job.result = job.corners;
      job.measured = 0;
      job.drift = {};
      job.why = kTangled;
    }
  });
}

}  // namespace gltfx::steps
