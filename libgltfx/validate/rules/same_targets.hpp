// SPDX-License-Identifier: Apache-2.0
/// Channels of one animation that move the same thing.
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "model/animation.hpp"
#include "validate/context.hpp"

namespace gltfx::validate {

class SameTargets {
 public:
  /// By nodes that are there and properties that nodes have;
  /// Deviations::targets_compare_as_written.
  SameTargets(const Context& context, const model::Animation& animation);

  /// Channels behind `channel` that have its target: the next one;
  /// Deviations::each_finding_is_listed: all of them as long as there are not too many.
  std::vector<std::size_t> behind(std::size_t channel);

 private:
  bool all_;
  std::vector<std::vector<std::size_t>> groups_;
  /// By channel: its group and the place in it.
  std::vector<std::pair<std::size_t, std::size_t>> place_;
  std::size_t left_;  ///< pairs that may be told; there are as many as the square of the channels
};

}  // namespace gltfx::validate
