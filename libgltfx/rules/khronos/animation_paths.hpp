// SPDX-License-Identifier: Apache-2.0
/// The pointers of the Khronos validator's findings in animations. After a channel without a
/// sampler index it continues as if it were still in that channel, so that later pointers keep its
/// steps, even after the animations.
#pragma once

#include <cstddef>
#include <deque>

#include "model/animation.hpp"
#include "rules/context.hpp"

namespace gltfx::validate {

/// Whether a channel has an index of a sampler, which may be missing.
bool has_sampler_index(const Context& context, const model::AnimationChannel& channel);

/// Whether references from the animation are followed: the Khronos validator needs both of its
/// lists.
bool is_linked(const Context& context, const model::Animation& animation);

/// A path from /animations on with steps that are pushed and popped.
class AnimationPaths {
 public:
  AnimationPaths() { push("animations"); }

  const Path& path() const { return steps_.empty() ? root_ : steps_.back(); }
  template <typename Step>
  void push(Step step) {
    if (steps_.size() < kMost) {
      steps_.emplace_back(path(), step);
    } else {
      ++beyond_;
    }
  }
  void pop() {
    if (beyond_ > 0) {
      --beyond_;
    } else if (!steps_.empty()) {
      steps_.pop_back();
    }
  }

 private:
  static constexpr std::size_t kMost = 32;  // enough to identify a pointer
  Path root_;
  std::deque<Path> steps_;
  std::size_t beyond_ = 0;
};

}  // namespace gltfx::validate
