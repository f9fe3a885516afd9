// SPDX-License-Identifier: Apache-2.0
/// The random numbers of a path, by step.
#pragma once

#include <cstdint>

#include "bake/sampler.hpp"

namespace gltfx::bake {

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
  environment_choice,
  emitter_choice,
  count
};

/// A path that splits gives each branch a part of its points, so that all branches together are
/// stratified.
class PathSampler {
 public:
  /// Layers of alpha along one ray have dimensions of their own.
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

  Float2 pair(Dimension d) const { return stream_.pair(number(d), branch_, branches_); }
  double single(Dimension d) const {
    return static_cast<double>(stream_.single(number(d), branch_, branches_));
  }
  /// For decisions that need no stratification.
  std::uint32_t key() const { return mix_bits(stream_.key(), branch_) + step_; }

 private:
  static constexpr std::uint32_t kFirst = 1;  // after the position in the pixel
  static constexpr auto kDimensions = static_cast<std::uint32_t>(Dimension::count);
  std::uint32_t number(Dimension d) const {
    return first_ + step_ * kDimensions + static_cast<std::uint32_t>(d);
  }

  SampleStream stream_;
  std::uint32_t first_;
  std::uint32_t branch_ = 0, branches_ = 1;
  std::uint32_t step_ = 0;
};

}  // namespace gltfx::bake
