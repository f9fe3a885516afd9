// SPDX-License-Identifier: Apache-2.0
#include "steps/upgrade/scattering.hpp"

#include <algorithm>
#include <cmath>

namespace gltfx::upgrade {
namespace {

// Fit of Kulla and Conty: s = kA + kB m - sqrt(kC + kD m + kE m^2), albedo = 1 - s^2.
constexpr double kA = 4.09712, kB = 4.20863, kC = 9.59217, kD = 41.6808, kE = 17.7126;

// Channels below this value count as this value: black would need an infinite coefficient.
constexpr double kDarkest = 1e-6;

}  // namespace

Rgb coefficient(const Rgb& color, double distance) {
  Rgb result{};
  for (std::size_t i = 0; i < color.size(); ++i) {
    // White results in 0, not in -0.
    const double log = std::log(std::max(color[i], kDarkest));
    result[i] = log == 0 ? 0 : -log / distance;
  }
  return result;
}

double multi_scatter_albedo(double single_scatter) {
  if (single_scatter >= 1) return 1;
  // (kA - s + kB m)^2 = kC + kD m + kE m^2 is a quadratic in m with a tiny first coefficient: this
  // is the root near that of the linear equation, in a form without cancellation.
  const double t = kA - std::sqrt(1 - single_scatter);
  const double first = kB * kB - kE;
  const double second = kD - 2 * kB * t;
  const double last = t * t - kC;
  const double m = 2 * last / (second + std::sqrt(second * second - 4 * first * last));
  return std::clamp(m, 0.0, 1.0);
}

Medium medium_of(const Rgb& scattering, const Rgb& absorption) {
  Rgb all{};
  Medium medium{};
  for (std::size_t i = 0; i < all.size(); ++i) all[i] = scattering[i] + absorption[i];
  medium.attenuation_distance = 3 / (all[0] + all[1] + all[2]);
  for (std::size_t i = 0; i < all.size(); ++i) {
    medium.attenuation_color[i] = std::exp(-all[i] * medium.attenuation_distance);
    const double albedo = all[i] > 0 ? scattering[i] / all[i] : 0;
    medium.multi_scatter_color[i] = multi_scatter_albedo(albedo);
  }
  return medium;
}

}  // namespace gltfx::upgrade
