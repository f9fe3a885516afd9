// SPDX-License-Identifier: Apache-2.0
/// Animations at one moment: curves between keyframes (specification section 3.11 and appendix C),
/// and the targets of their channels.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "model/accessor_data.hpp"
#include "model/animation.hpp"
#include "model/properties.hpp"
#include "schema/set.hpp"

namespace gltfx::model {

/// The keyframes of one sampler.
struct Curve {
  AccessorData times;   ///< seconds, increasing
  AccessorData values;  ///< as many elements as keyframes times values_per_keyframe() times width
  Interpolation interpolation = Interpolation::linear;
};

/// The value of a curve at `time`: before the first keyframe the first value, after the last one
/// the last. `width` elements belong together, such as the weights of all morph targets. Rotations
/// follow the shorter arc and have length 1. Empty when there are too few elements.
std::vector<float> value_at(const Curve& curve, double time, std::uint64_t width, bool rotation);

/// A channel of an animation that can be evaluated.
struct ClipChannel {
  std::string pointer;      ///< canonical JSON pointer of what it changes
  std::uint64_t width = 1;  ///< as value_at() takes it
  bool rotation = false;    ///< likewise
  Curve curve;
};

/// The greatest time of the keyframes of an animation, as `max` of their accessors states it;
/// seconds.
double duration_of(const Asset& asset, const Views& views, const Animation& animation);

/// The values of an animation at one moment.
struct AnimationSample {
  AnimatedValues values;
  std::vector<std::string> notes;  ///< channels that were left out and why, a sentence each
};

/// Evaluates all channels of animation `index` at `time` in seconds: those of nodes and those of
/// KHR_animation_pointer. Memory is bounded by the numbers that a scene can use.
AnimationSample sample_animation(const Asset& asset, const Views& views,
                                 const ResourceData& resources, const schema::Set& schemas,
                                 std::uint32_t index, double time);

/// The channels of animation `index`; those that cannot be evaluated are left out.
std::vector<ClipChannel> open_clip(const Asset& asset, const Views& views,
                                   const ResourceData& resources, const schema::Set& schemas,
                                   std::uint32_t index);

}  // namespace gltfx::model
