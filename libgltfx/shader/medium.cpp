// SPDX-License-Identifier: Apache-2.0
#include "shader/medium.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

#include "shader/directions.hpp"
#include "shader/sin_cos.hpp"

namespace gltfx::shader {
namespace {

template <class Function>
Rgb each(const Rgb& a, const Function& f) {
  return {f(a.x), f(a.y), f(a.z)};
}

// Attenuation that is shared between scattering and absorption.
void share(Medium& medium, const Rgb& extinction, const Rgb& albedo) {
  medium.scattering = extinction * albedo;
  medium.absorption = extinction - medium.scattering;
}

// Strength 0 is no scattering; the fit would leave a remainder.
Rgb albedo_of(const Material& m, double strength, double g) {
  return each(m.scatter_color, [&](double color) {
    return strength * color > 0 ? single_scatter_albedo(strength * color, g) : 0;
  });
}

// The probability of each colour.
Rgb color_odds(const Rgb& throughput) {
  const double sum = throughput.x + throughput.y + throughput.z;
  return sum > 0 ? throughput / Rgb(sum) : Rgb(1.0 / 3);
}

int choose_color(const Rgb& odds, double random) {
  if (random < odds.x) return 0;
  return random < odds.x + odds.y ? 1 : 2;
}

}  // namespace

Rgb Medium::transmittance(double distance) const {
  return each(extinction(),
              [distance](double sigma) { return sigma > 0 ? std::exp(-sigma * distance) : 1.0; });
}

Rgb coefficient(const Rgb& color, double distance) {
  if (!std::isfinite(distance)) return {};
  return each(color,
              [distance](double c) { return -std::log(std::clamp(c, 1e-6, 1.0)) / distance; });
}

double single_scatter_albedo(double m, double g) {
  const double s = 4.09712 + 4.20863 * m - std::sqrt(9.59217 + 41.6808 * m + 17.7126 * square(m));
  return (1 - square(s)) / (1 - g * square(s));
}

Medium medium_of(const Material& m) {
  Medium medium;
  const Rgb attenuation = coefficient(m.attenuation_color, m.attenuation_distance);
  switch (m.scattering) {
    case Scattering::none:
      medium.absorption = attenuation;
      break;
    case Scattering::distance:
      medium.absorption = attenuation;
      medium.scattering = coefficient(m.scatter_color, m.scatter_distance);
      break;
    case Scattering::multiscatter:
      share(medium, attenuation, albedo_of(m, 1, 0));
      medium.anisotropy = m.scatter_anisotropy;
      break;
    case Scattering::unified:
      share(medium, attenuation, albedo_of(m, m.scatter_strength, m.scatter_anisotropy));
      medium.anisotropy = m.scatter_anisotropy;
      break;
  }
  return medium;
}

double henyey_greenstein(double g, double v_dot_l) {
  // 1 + g^2 + 2 g v.l, without the cancellation near its smallest values.
  const double base =
      g < 0 ? square(1 + g) - 2 * g * (1 - v_dot_l) : square(1 - g) + 2 * g * (1 + v_dot_l);
  return inv_pi / 4 * (1 - square(g)) / (base * std::sqrt(base));
}

Vec3d sample_phase(const Medium& medium, const Vec3d& along, double u, double v) {
  const double g = medium.anisotropy;
  const double k = (1 - square(g)) / (1 - g + 2 * g * u);
  const double cosine = std::fabs(g) < 1e-6
                            ? 2 * u - 1
                            : std::clamp((1 + square(g) - square(k)) / (2 * g), -1.0, 1.0);
  const double sine = std::sqrt(std::max(0.0, 1 - square(cosine)));
  // Normalized again by a Newton step: paths have hundreds of directions.
  const SinCos turn = sin_cos_of(v);
  const double side = sine * (1.5 - 0.5 * (square(turn.sine) + square(turn.cosine)));
  // A frame around the direction (T. Duff et al., Building an Orthonormal Basis, Revisited, 2017).
  const double sign = std::copysign(1.0, along.z);
  const double a = -1 / (sign + along.z);
  const double b = along.x * along.y * a;
  const Vec3d x(1 + sign * square(along.x) * a, sign * b, -sign * along.x);
  const Vec3d y(b, sign + square(along.y) * a, -along.y);
  return side * turn.cosine * x + side * turn.sine * y + cosine * along;
}

void MediaStack::enter(const Material& material, std::uint64_t body) {
  constexpr std::size_t kDeepest = 16;
  if (entries_.size() < kDeepest) {
    entries_.push_back({medium_of(material), material.ior, body});
  }
}

void MediaStack::leave(std::uint64_t body) {
  const auto innermost = std::find_if(entries_.rbegin(), entries_.rend(),
                                      [body](const Entry& each) { return each.body == body; });
  if (innermost != entries_.rend()) entries_.erase(std::next(innermost).base());
}

const MediaStack::Entry* MediaStack::entry_around(std::uint64_t body) const {
  const auto around = std::find_if(entries_.rbegin(), entries_.rend(),
                                   [body](const Entry& each) { return each.body != body; });
  return around != entries_.rend() ? &*around : nullptr;
}

const Medium* MediaStack::around(std::uint64_t body) const {
  const Entry* entry = entry_around(body);
  return entry != nullptr ? &entry->medium : nullptr;
}

double MediaStack::ior_around(std::uint64_t body) const {
  const Entry* entry = entry_around(body);
  return entry != nullptr ? entry->ior : 1.0;
}

double sample_distance(const Medium& medium, const Rgb& throughput, const Float2& random) {
  constexpr double kNever = std::numeric_limits<double>::infinity();
  if (!medium.scatters()) return kNever;
  const int color = choose_color(color_odds(throughput), static_cast<double>(random[1]));
  const double decisive = medium.extinction()[color];
  return decisive > 0 ? static_cast<double>(-std::log(1 - random[0])) / decisive : kNever;
}

Rgb distance_weight(const Medium& medium, const Rgb& throughput, double distance, bool scattered) {
  if (!medium.scatters()) return medium.transmittance(distance);
  const Rgb extinction = medium.extinction();
  if (medium.is_grey()) return scattered ? medium.scattering / extinction : Rgb(1);
  const Rgb odds = color_odds(throughput);
  const Rgb through = medium.transmittance(distance);
  const double density = dot(odds, scattered ? extinction * through : through);
  const Rgb carried = scattered ? medium.scattering * through : through;
  return density > 0 ? carried / Rgb(density) : Rgb();
}

}  // namespace gltfx::shader
