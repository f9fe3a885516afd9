// SPDX-License-Identifier: Apache-2.0
#include "bake/media.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

namespace gltfx::bake {
namespace {

// How likely each colour is to decide.
Rgb color_odds(const Rgb& throughput) {
  const double sum = throughput.x + throughput.y + throughput.z;
  return sum > 0 ? throughput / Rgb(sum) : Rgb(1.0 / 3);
}

int choose_color(const Rgb& odds, double random) {
  if (random < odds.x) return 0;
  return random < odds.x + odds.y ? 1 : 2;
}

}  // namespace

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

DistanceSample sample_distance(const Medium& medium, const Rgb& throughput, double reach,
                               const Float2& random) {
  if (!medium.scatters()) return {false, 0, medium.transmittance(reach)};
  const Rgb extinction = medium.extinction();
  const Rgb odds = color_odds(throughput);
  const double decisive = extinction[choose_color(odds, static_cast<double>(random[1]))];
  const double distance = decisive > 0 ? -std::log1p(-static_cast<double>(random[0])) / decisive
                                       : std::numeric_limits<double>::infinity();
  if (distance >= reach) {
    const Rgb through = medium.transmittance(reach);
    const double density = dot(odds, through);
    return {false, 0, density > 0 ? through / Rgb(density) : Rgb()};
  }
  const Rgb through = medium.transmittance(distance);
  const double density = dot(odds, extinction * through);
  return {true, distance, density > 0 ? medium.scattering * through / Rgb(density) : Rgb()};
}

}  // namespace gltfx::bake
