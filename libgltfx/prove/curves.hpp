// SPDX-License-Identifier: Apache-2.0
/// Compares the motion of animation channels, independent of their keyframes.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "model/animation.hpp"
#include "model/keyframes.hpp"
#include "prove/differences.hpp"
#include "prove/side.hpp"

namespace gltfx::prove {

/// The curve of a channel and its interpretation.
struct Motion {
  model::Curve curve;
  std::uint64_t width = 1;
  model::AnimationPath path = model::AnimationPath::none;

  double time(std::uint64_t keyframe) const;
  double last() const { return time(curve.times.count() - 1); }
  std::vector<float> at(double moment) const {
    return model::value_at(curve, moment, width, path == model::AnimationPath::rotation);
  }
};

/// A channel and its sampler, which are in one animation.
struct Sampled {
  const model::AnimationChannel* channel = nullptr;
  const model::AnimationSampler* sampler = nullptr;
};
/// `channel`: an object. Nothing: it has no sampler.
std::optional<Sampled> find_sampled(const Side& side, json::NodeId channel);
/// Nothing: it cannot be read.
std::optional<Motion> open_motion(const Side& side, json::NodeId channel);

/// The greatest distance of two values with the same number of components; of rotations, which may
/// be negated.
double value_distance(const std::vector<float>& a, const std::vector<float>& b, bool rotation);

/// What a channel moves and how, by the numbers of the accessors.
std::string curve_key(const Side& side, json::NodeId channel);

/// `pair`: objects of channels. See AnimationComparison::curves.
void compare_curves(const Side& before, const Side& after, const Pair& pair,
                    const Tolerance& tolerance, Differences& found);

}  // namespace gltfx::prove
