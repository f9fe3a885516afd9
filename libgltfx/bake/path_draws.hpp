// SPDX-License-Identifier: Apache-2.0
/// What a path draws by chance.
#pragma once

#include <gltfx/vec3.hpp>

#include <algorithm>
#include <cstdint>

namespace gltfx::bake {

constexpr std::uint32_t kSteps = 1024;  // of a path, in media and on surfaces

// Dimensions of the random numbers of one step of a path.
enum Draw : std::uint32_t {
  lobe,
  direction,
  environment,
  emitter,
  lamp,
  roulette,
  reach,
  turn,
  color,
  choice,
  emitter_choice,
  kDraws
};
constexpr std::uint32_t kFirstDraw = 1;  // after the position in the pixel

// Of the random number that chooses among lobes.
struct Range {
  double from = 0, to = 1;
  double at(double part) const { return from + part * (to - from); }
};

// What part of light another one is, by colour; from 0 to 1.
inline Rgb part(const Rgb& some, const Rgb& all) {
  const auto ratio = [](double a, double b) { return b > 0 ? std::clamp(a / b, 0.0, 1.0) : 0.0; };
  return {ratio(some.x, all.x), ratio(some.y, all.y), ratio(some.z, all.z)};
}

}  // namespace gltfx::bake
