// SPDX-License-Identifier: Apache-2.0
#include "pipeline/bake_refusal.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include <fmt/format.h>

namespace gltfx {

std::optional<std::string> find_refusal(const BakeOptions& options) {
  constexpr std::uint32_t kMostPixels = 16384;          // along a side
  constexpr std::uint64_t kMostInAll = 8192ULL * 8192;  // of some hundred bytes each
  constexpr double kMostStops = 64;
  const auto is_fine = [](const BakeSize& size) {
    return std::min(size.width, size.height) > 0 &&
           std::max(size.width, size.height) <= kMostPixels &&
           std::uint64_t{size.width} * size.height <= kMostInAll;
  };
  if (options.sizes.empty() || !std::all_of(options.sizes.begin(), options.sizes.end(), is_fine)) {
    return fmt::format("each size needs sides from 1 to {} pixels, and {} pixels in all at most",
                       kMostPixels, kMostInAll);
  }
  if (options.samples && (*options.samples == 0 || *options.samples > kMostBakeSamples)) {
    return fmt::format("samples: not from 1 to {} a pixel", kMostBakeSamples);
  }
  if (options.interior == BakeInterior::on && !options.frame.empty()) {
    return "a view from inside shows the room, so no node can be framed";
  }
  if (options.interior == BakeInterior::on && options.projection != BakeProjection::perspective) {
    return "a view from inside needs a perspective camera";
  }
  if (!(std::fabs(options.exposure) <= kMostStops)) {
    return fmt::format("exposure: not from -{0} to {0} stops", kMostStops);
  }
  if (!std::isfinite(options.environment_rotation))
    return "environment_rotation: not a finite number";
  if (options.fps != 0 && !(options.fps >= 0.01 && options.fps <= 1000)) {
    return "fps: neither 0 nor from 0.01 to 1000";
  }
  if (options.turntable > kMostBakeFrames) {
    return fmt::format("turntable: more than {} frames", kMostBakeFrames);
  }
  if (!options.clip.empty() && (options.turntable > 0 || !options.animation.empty())) {
    return "a clip cannot be combined with a turntable or another animation";
  }
  return std::nullopt;
}

}  // namespace gltfx
