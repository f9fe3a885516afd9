// SPDX-License-Identifier: Apache-2.0
#include "steps/simplify_drift.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "base/parallel.hpp"
#include "steps/angle.hpp"

namespace gltfx::steps {
namespace {

using model::Vector3;

Vector3 value_at(const SimplifyValues& of, std::span<const std::uint32_t> corners,
                 const Vector3& weights) {
  Vector3 value{};
  for (std::size_t k = 0; k < 3; ++k) {
    const std::array<float, 3>& corner = of.values[corners[k]];
    for (std::size_t i = 0; i < 3; ++i) value[i] += weights[k] * double{corner[i]};
  }
  return value;
}

double length(const Vector3& a) { return std::sqrt(model::dot(a, a)); }
Vector3 minus(const Vector3& a, const Vector3& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

// Twice the area of the triangle of three values.
double area(const Vector3& a, const Vector3& b, const Vector3& c) {
  return length(model::cross(minus(b, a), minus(c, a)));
}

class DriftMeter {
 public:
  DriftMeter(const SimplifyJob& job, const model::SurfaceTree& after, double radius)
      : job_(job), before_(job.surface()), after_(after), radius_(radius) {}

  // Of one triangle, by values of the job.
  double at(std::size_t triangle, const SimplifyValues& values) const {
    constexpr Vector3 kCenter{1 / 3.0, 1 / 3.0, 1 / 3.0};
    const std::span<const std::uint32_t> corners = before_.corners.subspan(3 * triangle, 3);
    const Vector3 a = before_.corner(3 * triangle), b = before_.corner(3 * triangle + 1),
                  c = before_.corner(3 * triangle + 2);
    Vector3 center{};
    for (std::size_t i = 0; i < 3; ++i) center[i] = (a[i] + b[i] + c[i]) / 3;
    const Vector3 wanted = value_at(values, corners, kCenter);
    double per_value = 1;  // length on the surface
    if (!values.directions) {
      const double flat =
          area(value_at(values, corners, {1, 0, 0}), value_at(values, corners, {0, 1, 0}),
               value_at(values, corners, {0, 0, 1}));
      if (!(flat > 0)) return 0;  // the texture has no extent there
      per_value = std::sqrt(area(a, b, c) / flat) * job_.scale;
    }
    double best = std::numeric_limits<double>::infinity();
    constexpr int kMostTriangles = 512;  // many may be at one place
    int looked_at = 0;
    const auto look_at = [&](std::uint32_t near) {
      const model::Surface& surface = after_.surface();
      const std::size_t first = std::size_t{3} * near;
      const Vector3 weights = model::nearest_weights(
          center, surface.corner(first), surface.corner(first + 1), surface.corner(first + 2));
      const Vector3 found = value_at(values, surface.corners.subspan(first, 3), weights);
      best = std::min(best, values.directions ? angle_between(wanted, found)
                                              : per_value * length(minus(wanted, found)));
      return ++looked_at < kMostTriangles;
    };
    after_.each_near(center, radius_, look_at);
    if (!std::isfinite(best)) look_at(after_.nearest(center, 0, 0).triangle);
    return best;
  }

 private:
  const SimplifyJob& job_;
  const model::Surface before_;
  const model::SurfaceTree& after_;
  const double radius_;
};

}  // namespace

SimplifyDrift measure_drift(const SimplifyJob& job, const model::SurfaceTree& after, double radius,
                            unsigned jobs) {
  constexpr std::size_t kChunk = 4096;
  const std::size_t triangles = job.corners.size() / 3;
  const DriftMeter meter(job, after, radius);
  SimplifyDrift drift;
  std::vector<double> all(triangles);
  for (const auto& values : job.values) {
    parallel_ordered((triangles + kChunk - 1) / kChunk, jobs,
                     [&](std::size_t chunk) {
                       const std::size_t last = std::min((chunk + 1) * kChunk, triangles);
                       for (std::size_t i = chunk * kChunk; i < last; ++i)
                         all[i] = meter.at(i, values);
                     },
                     [](std::size_t) {});
    double& greatest = values.directions ? drift.angle : drift.slide;
    const auto most = all.begin() + static_cast<std::ptrdiff_t>((triangles - 1) * 99 / 100);
    std::nth_element(all.begin(), most, all.end());
    greatest = std::max(greatest, *most);
  }
  return drift;
}

}  // namespace gltfx::steps
