// SPDX-License-Identifier: Apache-2.0
/// The state of a path, and its random numbers by step.
#pragma once

#include <gltfx/material.hpp>

#include <array>
#include <cstdint>

#include "base/lanes.hpp"
#include "render/ray.hpp"
#include "render/sampler.hpp"
#include "render/sky_samples.hpp"
#include "shader/medium.hpp"

namespace gltfx::render {

constexpr std::uint32_t kMaxSteps = 1024;  // of a path, in media and on surfaces

/// Dimensions of one step.
enum class Dimension : std::uint32_t {
  lobe,
  direction,
  environment,
  emitter,
  punctual,
  roulette,
  free_flight,
  phase,
  color,
  emitter_choice,
  count
};

/// A path that splits gives each branch a part of its points, so that all branches together are
/// stratified.
class PathSampler {
 public:
  /// Layers of alpha along one ray have separate dimensions.
  PathSampler(const SampleStream& stream, std::uint32_t layer)
      : stream_(stream), first_(kFirst + layer * kMaxSteps * kDimensions) {}

  /// Number `i` of `count` branches, at the same step.
  PathSampler split(std::uint32_t i, std::uint32_t count) const {
    PathSampler branch(*this);
    branch.branch_ = branch_ * count + i;
    branch.branches_ = branches_ * count;
    return branch;
  }

  std::uint32_t step() const { return step_; }
  void next_step() { ++step_; }

  Float2 pair(Dimension d) const {
    return step_ < kStratified ? stream_.pair(number(d), branch_, branches_)
                               : stream_.random_pair(number(d), branch_, branches_);
  }
  /// The pairs of the branches from number `from` on of split(), for as many as there are lanes.
  std::array<Float2, kLanes> pairs(Dimension d, std::uint32_t from, std::uint32_t count) const {
    if (count == 1) return {pair(d)};
    const std::uint32_t first = branch_ * count + from;
    const std::uint32_t branches = branches_ * count;
    if (step_ < kStratified) return stream_.pairs(number(d), first, branches);
    std::array<Float2, kLanes> points;
    for (std::uint32_t i = 0; i < kLanes; ++i)
      points[i] = stream_.random_pair(number(d), first + i, branches);
    return points;
  }
  double single(Dimension d) const {
    return static_cast<double>(step_ < kStratified
                                   ? stream_.single(number(d), branch_, branches_)
                                   : stream_.random_single(number(d), branch_, branches_));
  }
  /// For decisions that need no stratification.
  std::uint32_t key() const { return mix_bits(stream_.key(), branch_) + step_; }

 private:
  static constexpr std::uint32_t kFirst = 1;        // after the position in the pixel
  static constexpr std::uint32_t kStratified = 12;  // steps: with more dimensions it is useless
  static constexpr auto kDimensions = static_cast<std::uint32_t>(Dimension::count);
  std::uint32_t number(Dimension d) const {
    return first_ + step_ * kDimensions + static_cast<std::uint32_t>(d);
  }

  SampleStream stream_;
  std::uint32_t first_;
  std::uint32_t branch_ = 0, branches_ = 1;
  std::uint32_t step_ = 0;
};

/// Properties of all vertices of a path so far.
struct PathPrefix {
  bool specular = true;         ///< only mirrors and clear glass
  bool straight = true;         ///< only sheets of clear glass
  bool environment_in = false;  ///< the environment came in through a wall
};

/// A path up to one of its vertices, as a value: a path that splits is copied.
struct PathState {
  Ray ray;
  PathSampler sampler;
  Rgb throughput{1, 1, 1};  ///< BSDFs, phase functions and cosines over densities
  double pdf = 0;           ///< of the ray's direction; 0: light sampling cannot find the hit
  SkyPdf sky_pdf{};         ///< of light sampling where the ray starts
  int depth = 0;            ///< surfaces that scattered
  int channel = -1;         ///< the only colour that it carries, after dispersion; -1: all
  double weight = 1;        ///< of a branch in the throughput
  Rgb reflected_share{};    ///< part of the throughput that the first surface reflects
  PathPrefix prefix{};
  shader::MediaStack media{};
};

}  // namespace gltfx::render
